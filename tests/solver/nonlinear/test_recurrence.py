"""Periods, by recurrence of the section."""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.nonlinear.recurrence import (
    creep_to_come,
    largest_extent,
    longest_in,
    may_recur_by_chance,
    recurrence_period,
)
from tests.solver.nonlinear.textbook import (
    HENON,
    Map,
    circle,
    delayed_logistic,
    impact_oscillator,
    logistic,
)

ONE = np.ones(1)


@pytest.mark.parametrize(
    ("rate", "period"), [(2.8, 1), (3.2, 2), (3.5, 4), (3.55, 8), (3.83, 3), (3.739, 5), (3.9, 0)]
)
def test_windows_of_the_logistic_map(rate: float, period: int) -> None:
    assert recurrence_period(logistic(rate).orbit(200, 2000), ONE, 1e-4) == period


def test_an_impact_a_period_is_period_one() -> None:
    section = impact_oscillator(0.05, 0.8, 2.4, 0.0).section(40, 150)
    assert recurrence_period(section, np.ones(2), 1e-5) == 1


@pytest.mark.parametrize(
    "section",
    [HENON.orbit(500, 100), delayed_logistic(2.1).orbit(500, 500)],
    ids=["chaos", "closed curve"],
)
def test_what_does_not_recur_has_no_period(section: np.ndarray) -> None:
    assert recurrence_period(section, np.ptp(section, axis=0), 1e-3) == 0


def test_creeping_along_a_curve_is_no_recurrence() -> None:
    """Each section is within the tolerance of the one before, but not of the first."""
    angle = 2.0 * math.pi * circle(1e-4, 0.3).orbit(500)[:, 0]
    section = np.column_stack([np.cos(angle), np.sin(angle)])
    assert np.abs(np.diff(section, axis=0)).max() < 1e-3
    assert recurrence_period(section, np.ones(2), 1e-3) == 0


def test_one_stray_section_breaks_the_period() -> None:
    section = np.tile([[0.0], [1.0]], (50, 1))
    assert recurrence_period(section, ONE, 1e-6) == 2
    section[37] += 1e-3
    assert recurrence_period(section, ONE, 1e-6) == 0


@pytest.mark.parametrize("stray", [-1e-3, 1e-3])
def test_a_turn_that_is_not_complete_counts(stray: float) -> None:
    section = np.append(np.tile([0.0, 1.0, 2.0], 20), stray)[:, None]
    assert recurrence_period(section, ONE, 1e-2) == 3
    assert recurrence_period(section, ONE, 1e-6) == 0


def test_the_tolerance_is_in_units_of_the_scale() -> None:
    section = np.tile([[0.0, 0.0], [1e-5, 3.0]], (20, 1))
    assert recurrence_period(section, np.array([1e-3, 1.0]), 0.1) == 2
    assert recurrence_period(section, np.array([1e-3, 100.0]), 0.1) == 1
    assert recurrence_period(section, np.array([1e-5, 100.0]), 0.1) == 2


def test_a_period_must_be_seen_three_times_and_a_short_one_twice() -> None:
    """Chaos that comes close to where it was stays close for a turn, not for two."""
    section = np.arange(6.0)[:, None]
    thrice = np.concatenate([section, section, section])
    assert recurrence_period(thrice, ONE, 1e-9) == 6
    assert recurrence_period(thrice[:-1], ONE, 1e-9) == 0
    short = np.concatenate([section[:4], section[:4]])
    assert recurrence_period(short, ONE, 1e-9) == 4
    assert recurrence_period(short[:-1], ONE, 1e-9) == 0
    assert recurrence_period(section[:1], ONE, 1e-9) == 0


def test_periods_beyond_the_longest_are_not_sought() -> None:
    section = np.tile(np.arange(40.0), 3)[:, None]
    assert recurrence_period(section, ONE, 1e-9) == 0
    assert recurrence_period(section, ONE, 1e-9, longest=40) == 40


@pytest.mark.parametrize(
    ("section", "scale", "tolerance", "message"),
    [
        (np.zeros((4, 2)), np.array([1.0, 0.0]), 1e-3, "must be positive"),
        (np.zeros((4, 2)), np.ones(2), -1.0, "tolerance not negative"),
        (np.zeros((4, 2)), np.ones(3), 1e-3, "scale"),
        (np.zeros(4), np.ones(1), 1e-3, "section is"),
        (np.full((4, 1), math.nan), np.ones(1), 1e-3, "finite points"),
    ],
)
def test_bad_input_is_refused(
    section: np.ndarray, scale: np.ndarray, tolerance: float, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        recurrence_period(section, scale, tolerance)


@given(
    st.lists(st.integers(-50, 50), min_size=1, max_size=16),
    st.integers(3, 5),
    st.integers(0, 2**32),
    st.floats(-1e3, 1e3),
    st.floats(1e-3, 1e3),
)
def test_it_is_the_smallest_period_wherever_it_lies_and_whatever_the_unit(
    cycle: list[int], turns: int, seed: int, shift: float, unit: float
) -> None:
    exact = np.array(cycle * turns, np.float64)[:, None]
    noise = np.random.default_rng(seed).uniform(-4e-4, 4e-4, exact.shape)
    smallest = next(p for p in range(1, len(cycle) + 1) if (exact[p:] == exact[:-p]).all())
    section = unit * (exact + noise + shift)
    assert recurrence_period(section, np.array([unit]), 0.5) == smallest


def test_a_period_whose_halves_still_come_closer_is_none() -> None:
    """Behind a doubling at the multiplier -0.99 the motion is of period one, and shows two."""
    number = np.arange(60)
    section = (0.01 * (-0.99) ** number)[:, None]
    assert largest_extent(section, 2) < 5e-3
    assert recurrence_period(section, np.ones(1), 5e-3) == 0
    settled = (0.01 * (-1.0) ** number)[:, None]
    assert recurrence_period(settled, np.ones(1), 5e-3) == 2


def dying_swing(frequency: float, decay: float, count: int) -> np.ndarray:
    """Return sections (count, 2) of a swing that dies out, of so many turns a section."""
    number = np.arange(count)
    turn = 2.0 * math.pi * frequency * number
    return 3e-3 * np.exp(-decay * number)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])


@pytest.mark.parametrize("decay", [3e-2, 1e-2, 3e-3])
@pytest.mark.parametrize(
    ("frequency", "count"),
    [(1 / 2, 4), (1 / 2, 6), (1 / 2, 50), (1 / 4, 8), (1 / 4, 13), (1 / 3, 9)],
)
def test_a_swing_that_dies_out_has_no_period_however_slowly(
    frequency: float, count: int, decay: float
) -> None:
    """It ends with period one. Two turns were too few to see that; slow ones looked steady."""
    section = dying_swing(frequency, decay, count)
    assert largest_extent(section, round(1 / frequency)) <= 3e-3
    assert recurrence_period(section, np.ones(2), 1e-3) == 0
    assert recurrence_period(dying_swing(frequency, 0.0, count), np.ones(2), 1e-3) > 1


def test_a_swing_that_turns_slowly_beside_half_the_frequency_has_no_period_of_two() -> None:
    """Its axis turns while it dies out: the distance of two sections even grows for a while."""
    for phase in np.linspace(0.0, math.pi, 7):
        number = np.arange(12)
        turn = math.pi * 1.005 * number + phase
        along = np.column_stack([np.cos(turn), 0.2 * np.sin(turn)])
        section = 2e-3 * np.exp(-0.005 * number)[:, None] * along
        assert recurrence_period(section, np.ones(2), 1e-3) in (0, 1)


def test_a_distance_that_grows_has_not_settled() -> None:
    """An unstable motion of period one is left for one of period two, or for chaos."""
    section = (1e-2 * (-1.004) ** np.arange(12))[:, None]
    assert largest_extent(section, 2) <= 1e-3
    assert recurrence_period(section, ONE, 1e-3) == 0


@pytest.mark.parametrize("beyond", [1e-4, 2e-3, 1e-2])
def test_doublings_of_a_map_are_told_from_what_precedes_them(beyond: float) -> None:
    """The logistic map doubles at 3; distances before and behind die out, to nothing or not."""
    for count in (4, 8, 12, 50):
        before = logistic(3.0 - beyond).orbit(count, round(3.0 / beyond))
        assert recurrence_period(before, ONE, 1e-3) in (0, 1)
        behind = logistic(3.0 + beyond).orbit(count, round(10.0 / beyond))
        assert recurrence_period(behind, ONE, 1e-3) == 2


def test_a_period_of_four_that_is_one_of_two_is_none() -> None:
    number = np.arange(80)
    quarters = np.array([0.0, 1.0, 0.02, 1.02])[number % 4]
    assert recurrence_period(quarters[:, None], np.ones(1), 1e-2) == 4
    closer = np.where(number % 4 >= 2, 0.02 * (0.99**number - 1.0), 0.0)
    assert recurrence_period((quarters + closer)[:, None], np.ones(1), 1.5e-2) == 0


@pytest.mark.parametrize(("factor", "period", "count"), [(0.98, 1, 8), (0.9, 1, 50), (0.99, 3, 12)])
def test_what_creeps_still_has_to_go_what_it_has_to_go(
    factor: float, period: int, count: int
) -> None:
    left = 0.3 * factor ** np.arange(count)
    section = np.arange(count) % period + left
    found = creep_to_come(section[:, None], period)
    assert found == pytest.approx(left[count - period], rel=1e-9)


def test_noise_does_not_creep() -> None:
    noise = np.random.default_rng(2).uniform(-1.0, 1.0, (48, 3))
    assert creep_to_come(noise, 1) == creep_to_come(noise, 2) == 0.0
    assert creep_to_come(np.ones((8, 2)), 1) == 0.0
    drift = np.column_stack([noise[:, 0], 0.9 ** np.arange(48.0)])
    assert creep_to_come(drift, 1) == pytest.approx(0.9**47)


CHAOS = {"one band": logistic(3.9), "two bands": logistic(3.65)}


@cache
def returns_of_chaos(name: str) -> list[tuple[np.ndarray, int, float]]:
    """Return records of 4 to 8 sections that recur, their periods and growths over whole orbits.

    At these numbers both maps are chaotic.
    """
    system = CHAOS[name]
    orbit = system.orbit(60_000, 100)
    scale, found = np.ptp(orbit, axis=0), []
    for count in (4, 5, 6, 8):
        for period in range(1, count // 2 + 1):
            near = (np.abs(orbit[period:] - orbit[:-period]) <= 1e-3 * scale).all(axis=1)
            runs = np.lib.stride_tricks.sliding_window_view(near, count - period).all(axis=1)
            for start in np.flatnonzero(runs):
                record = orbit[start : start + count]
                if recurrence_period(record, scale, 1e-3) == period:
                    found.append((record / scale, period, growth_of(system, record, period)))
    return found


def growth_of(system: Map, record: np.ndarray, period: int) -> float:
    """Return the logarithm by which a vector grows over the last whole orbits of a record."""
    turns = len(record) // period * period
    vector = np.linspace(1.0, 0.3, record.shape[1])
    vector /= np.sqrt((vector * vector).sum())
    for state in record[len(record) - turns :]:
        vector = system.jacobian(state) @ vector
    return float(np.log(np.sqrt((vector * vector).sum())))


@pytest.mark.parametrize("name", CHAOS)
def test_chaos_that_comes_back_for_a_while_may_do_so_by_chance(name: str) -> None:
    records = returns_of_chaos(name)
    assert len(records) > 50
    seen = [may_recur_by_chance(record, period, 1e-3) for record, period, _ in records]
    assert sum(seen) >= 0.9 * len(records)
    known = [
        may_recur_by_chance(record, period, 1e-3, growth) for record, period, growth in records
    ]
    assert sum(known) >= 0.97 * len(records)


def periodic_records() -> Iterator[tuple[np.ndarray, int, float]]:
    """Yield settled records of stable orbits of the logistic map of 1 to 16 sections."""
    for period, low, high in STABLE:
        for rate in np.linspace(low, high, 20):
            system = logistic(rate)
            orbit = system.orbit(4 * period, 3000)
            if np.ptp(orbit[::period]) < 1e-9:
                for count in {2 * period, 3 * period, 4 * period} - {2, 3}:
                    record = orbit[:count]
                    yield record, period, growth_of(system, record, period)


STABLE = [
    (1, 2.0, 2.95),
    (2, 3.05, 3.4),
    (3, 3.829, 3.841),
    (4, 3.46, 3.54),
    (5, 3.7383, 3.7411),
    (6, 3.6266, 3.6303),
    (8, 3.5445, 3.564),
    (16, 3.5645, 3.5685),
]
"""Periods, and rates between which they are stable."""


def test_what_is_periodic_is_so_however_short_its_record() -> None:
    periods = set()
    for record, period, growth in periodic_records():
        scale = np.maximum(np.ptp(record, axis=0), 0.1)
        if longest_in(len(record)) < period:
            continue
        assert recurrence_period(record, scale, 1e-3) == period
        assert not may_recur_by_chance(record / scale, period, 1e-3)
        assert not may_recur_by_chance(record / scale, period, 1e-3, growth)
        periods.add(period)
    assert periods == {1, 2, 3, 4, 5, 6, 8, 16}


def test_what_closes_in_is_no_chance_and_what_parts_may_be() -> None:
    k = np.arange(12.0)[:, None]
    assert not may_recur_by_chance(5e-4 * 0.8**k, 1, 1e-3)
    assert may_recur_by_chance(5e-4 * 0.8 ** (11.0 - k), 1, 1e-3)
    assert not may_recur_by_chance(5e-4 * 0.8 ** (11.0 - k), 1, 1e-3, -1.0)
    assert may_recur_by_chance(5e-4 * 0.8**k, 1, 1e-3, 2.0)
    assert not may_recur_by_chance(1e-5 * 0.8 ** (11.0 - k), 1, 1e-3)
    assert not may_recur_by_chance(1e-7 * 0.8 ** (11.0 - k), 1, 1e-3, 2.0)
