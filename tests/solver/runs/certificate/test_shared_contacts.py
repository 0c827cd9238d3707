"""Contacts that lanes share, on onsets made up for it."""

import math

import numpy as np
import pytest

from jointplay.solver.runs.certificate.contacts import _before, _shared

LANES = 7
ENDLESS = np.full(LANES, math.inf)
TIME = np.linspace(0.0, 10.0, 11)


def onsets(*changed: tuple[int, list[float]]) -> list[np.ndarray]:
    """Return four onsets of each lane, 1 s apart, but those of some lanes."""
    found = [np.array([1.0, 2.0, 3.0, 4.0]) for _ in range(LANES)]
    for lane, other in changed:
        found[lane] = np.array(other)
    return found


def test_lanes_that_agree_share_all() -> None:
    (own, bar), parting = _shared(onsets(), ENDLESS, 3.0)
    assert own.tolist() == [1.0, 2.0, 3.0, 4.0]
    assert bar.tolist() == [0.0] * 4
    assert parting == math.inf


def test_errors_are_what_lanes_are_apart() -> None:
    (_, bar), parting = _shared(onsets((0, [1.0, 2.1, 3.0, 4.0])), ENDLESS, 3.0)
    assert bar == pytest.approx([0.0, 0.3, 0.0, 0.0])
    assert parting == math.inf


@pytest.mark.parametrize("lane", range(LANES))
def test_lanes_part_where_one_has_a_contact_less(lane: int) -> None:
    (own, _), parting = _shared(onsets((lane, [1.0, 2.0, 3.0])), ENDLESS, 3.0)
    assert own[:3].tolist() == [1.0, 2.0, 3.0][: len(own)]
    assert len(own) == 3
    assert parting == 4.0


@pytest.mark.parametrize("lane", [0, 1, 4, 5, 6])
def test_lanes_part_where_one_missed_a_contact_and_has_the_next(lane: int) -> None:
    (own, _), parting = _shared(onsets((lane, [1.0, 3.0, 4.0])), ENDLESS, 3.0)
    assert own.tolist() == [1.0]  # the second of one is a whole contact from that of the others
    assert parting <= 2.0


def test_a_lane_that_was_left_behind_does_not_count_behind() -> None:
    reach = ENDLESS.copy()
    reach[0] = 2.5
    (own, _), parting = _shared(onsets((0, [1.0, 2.0])), reach, 3.0)
    assert own.tolist() == [1.0, 2.0, 3.0, 4.0]
    assert parting == math.inf


def test_no_contact_at_all_is_shared() -> None:
    (own, bar), parting = _shared([np.zeros(0)] * LANES, ENDLESS, 3.0)
    assert len(own) == len(bar) == 0
    assert parting == math.inf


def test_the_span_ends_at_an_instant_that_no_onset_may_be_on_either_side_of() -> None:
    none = np.zeros(0)
    assert _before(TIME, math.inf, 10.0, none, none) == 10.0
    assert _before(TIME, math.inf, 7.0, none, none) == 7.0
    assert _before(TIME, 7.0, 10.0, none, none) == 6.0
    assert _before(TIME, 7.0, 10.0, np.array([6.2]), np.array([0.3])) == 5.0
    assert _before(TIME, 7.0, 10.0, np.array([6.2]), np.array([0.1])) == 6.0
    assert _before(TIME, 7.0, 10.0, np.array([1.0]), np.array([9.0])) == 0.0
