"""Error bars that were lies once, and extremes in a flight, at ramps, in chatter, of bristles."""

import pytest

from benchmarks.lies.named import (
    bristles,
    chatter,
    companions,
    flight,
    friction,
    kinks_beside,
    meeting_again,
    ramps,
)
from benchmarks.lies.named.lie import Lie

BARS = (
    *friction.BARS,
    flight.TURNED_BACK,
    kinks_beside.FORETOLD_TOO_HIGH,
    *ramps.LIES,
    *companions.LIES,
    *chatter.LIES,
    *bristles.LIES,
    *meeting_again.LIES,
)
AT_LENGTH = (
    "press as a draft, its bars",
    "press, an unlucky step",
    "press, fixed steps",
    "pendulum at the longest step",
    "press, a zigzag of step ends",
    "press, steps that swing in turn",
    "slider-crank, friction full at 0.0001 m/s",
    "slider-crank, friction full at 1e-05 m/s",
    "slider-crank, friction full at 3e-05 m/s",
    "slider-crank, rare impacts",
)
"""They compile the press in more ways, compare at length, or are steeper cases of another."""


@pytest.mark.parametrize(
    "lie",
    [
        pytest.param(lie, id=lie.name, marks=[pytest.mark.long] * (lie.name in AT_LENGTH))
        for lie in BARS
    ],
)
def test_what_was_a_lie_is_one_no_more(lie: Lie) -> None:
    found = lie.judge()
    assert found.true, found.said
