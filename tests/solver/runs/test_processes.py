"""Calls in several processes."""

import threading
from concurrent.futures.process import BrokenProcessPool

import pytest

from jointplay.solver.runs.processes import Call, Interrupted, processes
from tests.solver.runs.calls import doubled, endless, killed, noted, refused


def test_results_come_in_the_order_of_the_calls_and_progress_ends_at_one():
    reports: list[tuple[float, int, str]] = []
    calls = [Call(doubled, (number,), number + 1.0, number, "a call") for number in range(7)]
    with processes(2, most_calls=7) as pool:
        assert pool.make(calls, lambda *state: reports.append(state)) == [2 * n for n in range(7)]
        # the same processes again, for fewer calls
        assert pool.make(calls[:2]) == [0, 2]
    fractions = [fraction for fraction, _, _ in reports]
    assert fractions == sorted(fractions)
    assert reports[-1] == (1.0, sum(range(7)), "a call")


@pytest.mark.parametrize(("in_order", "written"), [(True, "light heavy "), (False, "heavy light ")])
def test_calls_are_made_the_heaviest_first_or_in_order(in_order, written, tmp_path):
    path = tmp_path / "made.txt"
    calls = [Call(noted, (path, "light"), 1.0), Call(noted, (path, "heavy"), 9.0)]
    with processes(1, most_calls=2) as pool:
        pool.make(calls, in_order=in_order)
    assert path.read_text() == written


def test_what_a_call_raises_is_raised_and_the_others_end():
    with processes(2, most_calls=2) as pool:
        calls = [Call(endless, (), 2.0), Call(refused, ("no such thing",), 1.0)]
        with pytest.raises(ValueError, match="no such thing"):
            pool.make(calls)


def test_being_asked_to_end_ends_the_calls():
    asked = threading.Event()
    reports: list[float] = []

    def ask_once_it_runs(fraction: float, *_: object) -> None:
        reports.append(fraction)
        if fraction > 0.0:
            asked.set()

    with processes(1, 1, asked.is_set) as pool, pytest.raises(Interrupted):
        pool.make([Call(endless, ())], ask_once_it_runs)
    assert reports[-1] == 0.25


def test_a_process_that_dies_is_noticed():
    with processes(2, most_calls=2) as pool:
        calls = [Call(endless, (), 2.0), Call(killed, (), 1.0)]
        with pytest.raises(BrokenProcessPool):
            pool.make(calls)
