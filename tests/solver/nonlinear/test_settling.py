"""Settling: when it is said, why, and that it is said in time."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.nonlinear.settling import SETTLINGS, Settled, Settling
from tests.solver.nonlinear.textbook import HENON, circle, delayed_logistic, logistic

RECURRENCE, STATISTICS = SETTLINGS["recurrence"], SETTLINGS["statistics"]


def settled(sections: np.ndarray, tolerance: float = 1e-4, most: int = 1000) -> Settled:
    result = Settling(np.ones(sections.shape[1]), tolerance, most).feed(sections)
    assert result is not None
    return result


def test_codes_keep_their_meaning() -> None:
    assert SETTLINGS == {"unsettled": 0, "recurrence": 1, "statistics": 2}


@pytest.mark.parametrize(("rate", "period"), [(2.8, 1), (3.2, 2), (3.5, 4), (3.83, 3), (3.55, 8)])
def test_periodic_motion_settles_when_it_recurs(rate: float, period: int) -> None:
    found = settled(logistic(rate).orbit(1000))
    assert found.code == RECURRENCE
    assert f"have period {period} within" in found.reason
    assert 64 <= found.count <= 160


@pytest.mark.parametrize("factor", [0.9, 0.97, 0.99, 0.995])
def test_what_remains_of_a_slow_approach_is_within_the_tolerance(factor: float) -> None:
    sections = 1.0 + factor ** np.arange(3000.0)[:, None]
    found = settled(sections, 1e-3, most=3000)
    assert found.code != SETTLINGS["unsettled"]
    assert sections[found.count - 1, 0] - 1.0 <= 1e-3
    # nor much later than necessary: 64 sections of looking back, 16 between two looks
    assert found.count <= math.log(1e-3) / math.log(factor) + 64 + 16 + 1


@pytest.mark.parametrize("factor", [0.97, 0.99])
def test_spiralling_in_is_waited_for(factor: float) -> None:
    n = np.arange(3000.0)
    angle = 2.0 * math.pi * 0.2137 * n
    sections = factor ** n[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    found = settled(sections, 1e-3, most=3000)
    assert found.code == RECURRENCE
    assert np.abs(sections[found.count]).max() <= 1e-3


def test_an_amplitude_that_dies_out_is_waited_for() -> None:
    """Two branches close in on a point: the means agree from the start, the spread is smooth."""
    sections = (-0.98) ** np.arange(2000.0)[:, None]
    found = settled(sections, 1e-3, most=2000)
    assert found.code == RECURRENCE
    assert abs(sections[found.count, 0]) <= 1e-3


@pytest.mark.parametrize(
    "sections",
    [HENON.orbit(1000), logistic(3.9).orbit(1000), logistic(3.6).orbit(1000)],
    ids=["Hénon", "logistic 3.9", "two bands"],
)
def test_chaos_settles_when_its_statistics_are_steady(sections: np.ndarray) -> None:
    found = settled(sections)
    assert found.code == STATISTICS
    assert found.count <= 304
    assert "means and spreads" in found.reason


def test_a_closed_curve_settles_by_its_statistics() -> None:
    assert settled(delayed_logistic(2.1).orbit(1000, 500)).code == STATISTICS


def test_a_slow_beat_is_given_the_time_it_needs() -> None:
    """A modulation over 200 sections: 32 of them see a flank, longer windows whole beats."""
    n = np.arange(4000.0)
    beat = (2.0 + np.sin(2.0 * math.pi * n / 200.0)) * np.cos(2.0 * math.pi * 0.2137 * n)
    found = settled(beat[:, None], most=4000)
    assert found.code == STATISTICS
    assert found.count >= 400


@pytest.mark.parametrize("shift", [3.0, 10.0])
def test_a_transient_on_top_of_chaos_is_waited_for(shift: float) -> None:
    chaos = logistic(3.9).orbit(4000)
    late = []
    for lasting in (30.0, 100.0):
        sections = chaos + shift * np.exp(-np.arange(4000.0) / lasting)[:, None]
        found = settled(sections, most=4000)
        assert found.code == STATISTICS
        # what is left of it is small against the spread of the chaos, 0.3
        assert shift * math.exp(-found.count / lasting) < 0.15
        late.append(found.count)
    assert late[0] < late[1]


def test_what_keeps_drifting_never_settles_and_says_what_drifts() -> None:
    rng = np.random.default_rng(0)
    sections = np.column_stack([rng.standard_normal(600), np.linspace(0.0, 9.0, 600)])
    sections[:, 1] += 0.3 * rng.standard_normal(600)
    found = settled(sections, most=600)
    assert found == Settled(SETTLINGS["unsettled"], 600, found.reason)
    assert found.reason == (
        "not settled after 600 sections: the mean of column 1 still changes over 135 sections"
    )


def test_growing_oscillations_never_settle() -> None:
    n = np.arange(600.0)
    sections = (np.exp(n / 200.0) * np.cos(2.0 * math.pi * 0.2137 * n))[:, None]
    found = settled(sections, most=600)
    assert found.code == SETTLINGS["unsettled"]
    assert "spread of column 0" in found.reason


def test_few_sections_say_so() -> None:
    found = settled(np.zeros((20, 1)), most=10)
    assert (found.code, found.count) == (SETTLINGS["unsettled"], 10)
    assert "too few" in found.reason


def test_creeping_along_a_curve_is_not_recurrence() -> None:
    angle = 2.0 * math.pi * circle(1e-4, 0.3).orbit(300)[:, 0]
    found = settled(np.column_stack([np.cos(angle), np.sin(angle)]), 1e-2, most=300)
    assert found.code == SETTLINGS["unsettled"]


def test_the_scale_sets_what_matters() -> None:
    noise = 1e-6 * np.random.default_rng(1).standard_normal((200, 1))
    assert Settling(np.array([1.0]), 1e-4).feed(noise).code == RECURRENCE
    assert Settling(np.array([1e-6]), 1e-4).feed(noise).code == STATISTICS


def test_nothing_changes_after_the_decision() -> None:
    settling = Settling(np.ones(1), 1e-4)
    first = settling.feed(np.zeros((100, 1)))
    assert first is not None
    assert first.count == 64
    assert settling.feed(np.random.default_rng(0).standard_normal((500, 1))) is first
    assert len(settling.sections) == 64


@settings(max_examples=30)
@given(
    st.lists(st.integers(1, 90), min_size=1, max_size=12),
    st.sampled_from([2.8, 3.2, 3.55, 3.6, 3.9]),
)
def test_portions_and_interruptions_do_not_matter(portions: list[int], rate: float) -> None:
    sections = logistic(rate).orbit(400)
    expected = Settling(np.ones(1), 1e-4, most=400).feed(sections)
    settling = Settling(np.ones(1), 1e-4, most=400)
    start = 0
    for portion in portions:
        settling.feed(sections[start : start + portion])
        start += portion
        resumed = Settling(np.ones(1), 1e-4, most=400)
        assert resumed.feed(settling.sections) == settling.result
        settling = resumed
    assert settling.feed(sections[start:]) == expected


@pytest.mark.parametrize(
    ("scale", "tolerance", "most"), [([0.0], 1e-3, 10), ([1.0], -1.0, 10), ([1.0], 1e-3, 0)]
)
def test_bad_input_is_refused(scale: list[float], tolerance: float, most: int) -> None:
    with pytest.raises(ValueError, match="must be positive"):
        Settling(np.array(scale), tolerance, most)


def test_sections_must_be_finite() -> None:
    with pytest.raises(ValueError, match="finite sections"):
        Settling(np.ones(1), 1e-3).feed(np.array([[math.nan]]))
