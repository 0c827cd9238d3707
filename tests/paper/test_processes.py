"""Calls in several processes."""

import os
import signal
import threading
from concurrent.futures.process import BrokenProcessPool

import pytest
from tests.paper.calls import doubled, endless, killed, refused

from jointplay.paper.processes import Call, Interrupted, processes


def test_results_come_in_the_order_of_the_calls_and_progress_ends_at_one():
    reports: list[tuple[float, str]] = []
    calls = [Call(doubled, (number,), float(number + 1)) for number in range(7)]
    with processes(2, most_calls=7) as crew:
        assert crew.make(calls, lambda *told: reports.append(told)) == [2 * n for n in range(7)]
        # the same processes again, for fewer calls
        assert crew.make(calls[:2], lambda *told: None) == [0, 2]
    fractions = [fraction for fraction, _ in reports]
    assert fractions == sorted(fractions)
    assert reports[-1] == (1.0, "7 of 7")


def test_what_a_call_raises_is_raised_and_nobody_goes_on():
    with processes(2, most_calls=2) as crew:
        calls = [Call(endless, (), 2.0), Call(refused, ("no such thing",), 1.0)]
        with pytest.raises(ValueError, match="no such thing"):
            crew.make(calls, lambda *told: None)


def test_ctrl_c_ends_the_calls():
    def press() -> None:
        os.kill(os.getpid(), signal.SIGINT)

    pressed = threading.Timer(3.0, press)
    with processes(1, most_calls=1) as crew:
        pressed.start()
        with pytest.raises(Interrupted):
            crew.make([Call(endless, (), 1.0)], lambda *told: None)
    pressed.join()


def test_a_process_that_dies_is_noticed():
    with processes(2, most_calls=2) as crew:
        calls = [Call(endless, (), 2.0), Call(killed, (), 1.0)]
        with pytest.raises(BrokenProcessPool):
            crew.make(calls, lambda *told: None)
