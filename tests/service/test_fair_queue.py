"""Owners take turns at what few can have at a time, and none of them takes all threads."""

import threading
from collections.abc import Callable

import pytest

from jointplay.service.fair_queue import OF_ONE, OF_ONE_EVERYWHERE, FairQueue, Full
from tests.waiting import until


def waiting(queue: FairQueue, owner: str, count: int, act: Callable[[], object]) -> None:
    """Have threads of an owner wait for a place, one after the other, and do something there."""

    def ask() -> None:
        with queue.place(owner):
            act()

    for _ in range(count):
        before = queue.waiting()
        threading.Thread(target=ask, daemon=True).start()
        until(lambda before=before: queue.waiting() == before + 1)


def test_an_owner_who_waits_often_is_told_so_and_no_other() -> None:
    queue, served = FairQueue(2), []
    with queue.place("x"), queue.place("y"):
        waiting(queue, "ada", OF_ONE, lambda: served.append("ada"))
        with pytest.raises(Full), queue.place("ada"):
            pass
        waiting(queue, "bob", 1, lambda: served.append("bob"))
    until(lambda: len(served) == OF_ONE + 1)


def test_an_owner_has_one_place_at_a_time() -> None:
    queue = FairQueue(2)
    with queue.place("ada") as first:
        waiting(queue, "ada", 1, lambda: None)
        with queue.place("bob") as second:
            assert {first, second} == {0, 1}
            assert queue.waiting() == 1
    until(lambda: not queue.waiting())


def test_one_place_goes_round() -> None:
    queue, served = FairQueue(1), []
    with queue.place("x"):
        waiting(queue, "ada", 3, lambda: served.append("ada"))
        waiting(queue, "bob", 2, lambda: served.append("bob"))
        waiting(queue, "eve", 1, lambda: served.append("eve"))
    until(lambda: len(served) == 6)
    assert served == ["ada", "bob", "eve", "ada", "bob", "ada"]


def test_an_owner_has_not_all_threads_of_all_queues() -> None:
    queues, go = [FairQueue(2) for _ in range(5)], threading.Event()
    held = 0

    def ask(queue: FairQueue) -> None:
        with queue.place("ada"):
            go.wait()

    for queue in queues:
        for _ in range(OF_ONE):
            if held < OF_ONE_EVERYWHERE:
                threading.Thread(target=ask, args=(queue,), daemon=True).start()
                held += 1
                until(lambda held=held: FairQueue._everywhere["ada"] == held)
    for queue in queues:
        with pytest.raises(Full), queue.place("ada"):
            pass
        with queue.place("bob"):
            pass
    go.set()
    until(lambda: not FairQueue._everywhere.total())
