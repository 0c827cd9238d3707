"""Requests of many threads that are answered together: in turns, and whatever one of them does."""

import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import pytest

from jointplay.storage.catalogue.group_commit import GroupCommit
from tests.waiting import until


def test_whoever_waits_is_next_even_if_the_one_before_asks_again_at_once() -> None:
    waits = threading.Event()
    rounds: list[tuple[str, list[str]]] = []

    def answer(asked: Sequence[str]) -> list[str]:
        rounds.append((threading.current_thread().name, [*asked]))
        waits.wait()
        return [one.upper() for one in asked]

    group = GroupCommit(answer, common=RuntimeError)

    def ask_again_and_again() -> None:
        for _ in range(100):
            assert group.done("eager") == "EAGER"

    eager = threading.Thread(target=ask_again_and_again, name="eager")
    patient = threading.Thread(target=group.done, args=("patient",), name="patient")
    eager.start()
    until(lambda: bool(rounds))
    patient.start()
    until(lambda: len(group._waiting) == 1)
    waits.set()
    eager.join()
    patient.join()
    assert rounds[0] == ("eager", ["eager"])
    assert rounds[1][0] == "patient"
    assert rounds[1][1][0] == "patient"
    assert sum(asked.count("eager") for _, asked in rounds) == 100


def test_an_error_that_is_one_requests_own_spoils_no_other() -> None:
    def answer(asked: Sequence[int]) -> list[float]:
        return [1.0 / one for one in asked]

    group = GroupCommit(answer, common=RuntimeError)
    with ThreadPoolExecutor(8) as threads:
        found = [threads.submit(group.done, number % 8) for number in range(400)]
    for number, one in enumerate(found):
        if number % 8:
            assert one.result() == 1.0 / (number % 8)
        else:
            with pytest.raises(ZeroDivisionError):
                one.result()
    assert group.done(2) == 0.5
