"""Curves of special orbits over two parameters, of maps where they are known exactly."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row
from jointplay.solver.continuation.special_curve import errors, passes
from tests.solver.continuation.known_maps import curve_of


def henon(state: Floats, a: float, b: float) -> list[float]:
    x, y = state.tolist()
    return [a - x * x + b * y, x]


def cusped(state: Floats, p: float, q: float) -> list[float]:
    x, y = state.tolist()
    return [x + 0.5 * (p + q * x - x**3), 0.3 * y]


def cusped_but_for_errors(state: Floats, p: float, q: float) -> list[float]:
    """Return the same, but one of 20 ends is off by 1e-9, as of a run whose steps err the most."""
    x, y = cusped(state, p, q)
    return [x + 1e-9 * (math.sin(1e9 * (state[0] + 0.3 * state[1] + 0.1 * q)) > 0.99), y]


def bogdanov(state: Floats, p: float, q: float) -> list[float]:
    x, y = state.tolist()
    y = y + q * y + p + x * x
    return [x + y, y]


def delayed_logistic(state: Floats, a: float, b: float) -> list[float]:
    x, y = state.tolist()
    return [a * x * (1.0 - b * x - (1.0 - b) * y), x]


def turning_beside_one(state: Floats, p: float, q: float) -> list[float]:
    x, y, z = state.tolist()
    return [*bogdanov(np.array([x, y]), q, p), (q + 2.5) * z]


def doubling_beside_two(state: Floats, p: float, q: float) -> list[float]:
    x, y, z = state.tolist()
    return [
        -(1.0 + p) * x + 0.6 * x * x + q * x**3 + 0.7 * x * y + x * z - x**5,
        0.3 * y + x * x,
        (q + 0.4) * z + x * x,
    ]


def linear_but_for_noise(state: Floats, p: float, q: float) -> list[float]:
    x, y = state.tolist()
    noise = 1e-12 * math.sin(1e9 * (x + 0.3 * y + 0.1 * q))
    return [-(1.0 + p + q) * x + noise, 0.3 * y]


def of_trace_and_determinant(state: Floats, trace: float, determinant: float) -> list[float]:
    x, y = state.tolist()
    return [y, trace * y - determinant * x]


def touching(state: Floats, p: float, q: float) -> list[float]:
    x, y = state.tolist()
    struck = 30.0 * math.sqrt(max(nearness(state, p, q), 0.0))
    return [0.5 * x + p + struck, 0.3 * y + q * q]


def nearness(state: Floats, p: float, q: float) -> float:
    x, y = state.tolist()
    return x * x + y - 1.0 + 0.3 * q


def strikes(state: Floats, p: float, q: float) -> int:
    return int(nearness(state, p, q) > 0.0)


def special(rows: list[Row], of: str) -> list[tuple[str, tuple[float, ...]]]:
    return [(row.label, row.orbit.values) for row in rows if row.label not in ("", "EP", of)]


def known_within_errors(rows: list[Row], formula: object) -> None:
    assert len(rows) > 20
    for row in rows:
        value, second = row.orbit.values
        away = abs(value - formula(second))  # type: ignore[operator]
        slope = abs(formula(second + 1e-4) - formula(second - 1e-4)) / 2e-4  # type: ignore[operator]
        bound, second_bound = errors(row.orbit)
        # of a determinant of differences, which are smooth to 1e-8
        assert away <= bound + slope * second_bound + 1e-9
        assert max(bound, second_bound) < 1e-6


def test_folds_and_doublings_of_henons_map_are_parabolas_of_its_second_parameter() -> None:
    folds = curve_of("LP", henon, [-0.3, -0.3], (-0.1, 0.3), ((-1.5, 1.0), (-0.9, 0.9)))
    known_within_errors(folds, lambda b: -((1.0 - b) ** 2) / 4.0)
    doublings = curve_of("PD", henon, [0.7, 0.7], (0.3675, 0.3), ((-0.1, 3.0), (-0.9, 1.5)))
    known_within_errors(doublings, lambda b: 0.75 * (1.0 - b) ** 2)
    assert {row.note for row in (folds[0], folds[-1])} == {"end of the range"}
    assert folds[0].orbit.values[1] == -0.9
    # where the map keeps its area the orbit that doubles folds, too
    ((label, at),) = special(doublings, "PD")
    assert (label, at) == ("LP", pytest.approx((0.0, 1.0), abs=1e-6))


def test_two_folds_meet_in_a_cusp_which_one_curve_passes() -> None:
    rows = curve_of("LP", cusped, [0.7, 0.0], (0.7**3 - 0.7, 1.0), ((-2.0, 2.0), (-1.0, 2.0)))
    side = rows[0].orbit.value
    for row in rows:
        p, q = row.orbit.values
        assert 27.0 * p * p == pytest.approx(4.0 * q**3, abs=1e-7)
    (cusp,) = [row for row in rows if row.label == "CP"]
    assert np.abs(cusp.orbit.values).max() < 1e-8
    assert rows[-1].orbit.value == pytest.approx(-side)
    other = curve_of("LP", cusped, [-0.7, 0.0], (0.7 - 0.7**3, 1.0), ((-2.0, 2.0), (-1.0, 2.0)))
    assert passes(rows, next(row.orbit for row in other if row.length == 0.0))
    assert not passes(rows[len(rows) // 2 :], other[-1].orbit)


def test_a_cusp_is_found_where_differences_of_one_scale_are_spoilt() -> None:
    start, ranges = [3.0**-0.5, 0.0], ((-1.0, 1.0), (-0.5, 1.5))
    rows = curve_of("LP", cusped_but_for_errors, start, (-2.0 / 27.0**0.5, 1.0), ranges)
    (cusp,) = [row for row in rows if row.label == "CP"]
    assert np.abs(cusp.orbit.values).max() < 1e-8


def test_resonances_are_named_where_a_second_multiplier_comes_to_the_same_place() -> None:
    folds = curve_of("LP", bogdanov, [0.1, 0.0], (-0.01, 0.2), ((-1.0, 1.0), (-0.4, 0.4)))
    assert special(folds, "LP") == [("R1", pytest.approx((0.0, 0.0), abs=1e-7))]
    doublings = curve_of(
        "PD", of_trace_and_determinant, [0.0, 0.0], (-1.5, 0.5), ((-3.0, 0.0), (0.2, 1.4))
    )
    assert special(doublings, "PD") == [("R2", pytest.approx((-2.0, 1.0), abs=1e-7))]


def test_pairs_on_the_unit_circle_are_followed_through_their_strong_resonances() -> None:
    b = 0.3
    a, x = 1.0 + 1.0 / (1.0 - b), 1.0 / (2.0 - b)
    rows = curve_of("NS", delayed_logistic, [x, x], (a, b), ((1.5, 6.0), (0.1, 0.9)))
    known_within_errors(rows, lambda b: 1.0 + 1.0 / (1.0 - b))
    # the sum of the pair is (1 - 2 b) / (1 - b)
    places = {"R4": (3.0, 1.0 / 2.0), "R3": (4.0, 2.0 / 3.0), "R2": (5.0, 3.0 / 4.0)}
    found = [row for row in rows if row.label in places]
    assert [row.label for row in found] == list(places)
    for row in found:
        away = np.abs(np.subtract(row.orbit.values, places[row.label]))
        assert (away <= np.array(row.bounds) + errors(row.orbit)).all()
        assert max(row.bounds) < 1e-6
    assert rows[-1].label == "R2"
    assert rows[-1].note == "both multipliers meet at -1, and are real beyond: end of the curve"
    assert rows[0].note == "end of the range"


def test_a_pair_that_meets_at_one_ends_its_curve_and_other_multipliers_are_told_on_the_way() -> (
    None
):
    # multipliers are those of trace 2 + 2 x and determinant 1, where x^2 = -q, and 2.5 + q
    rows = curve_of(
        "NS", turning_beside_one, [-1.1, 0.0, 0.0], (0.0, -1.21), ((-1.0, 1.0), (-9.0, 1.0))
    )
    assert special(rows, "NS") == [
        (label, pytest.approx((0.0, q), abs=1e-6))
        for label, q in (
            ("R2", -4.0),
            ("PD", -3.5),
            ("R3", -2.25),
            ("LP", -1.5),
            ("R4", -1.0),
            ("R1", 0.0),
        )
    ]


def test_a_doubling_turns_from_soft_to_hard_where_its_cubic_coefficient_vanishes() -> None:
    ranges = ((-0.5, 0.5), (-2.0, 1.0))
    rows = curve_of("PD", doubling_beside_two, [0.0] * 3, (0.0, -1.0), ranges)

    def cubic(q: float) -> float:
        return q + 0.6**2 + 0.7 / (1.0 - 0.3) + 1.0 / (1.0 - (q + 0.4))

    found = [row for row in rows if row.label not in ("", "EP", "PD")]
    # its pole at the fold, where it changes its sign, too, is none
    assert [row.label for row in found] == ["GPD", "R2", "LP"]
    known, row = brentq(cubic, -2.0, -1.0), found[0]
    assert row.note == "period doubling is soft on the side of the start, hard beyond"
    assert np.abs(np.subtract(row.orbit.values, (0.0, known))).max() <= max(row.bounds) < 1e-3
    # distances of a hundredth leave errors of their square
    for row in [row for row in rows if not row.label][::9]:
        assert row.orbit.criticality[0] == pytest.approx(cubic(row.orbit.values[1]), rel=1e-4)


def test_a_doubling_is_generalised_where_distances_leave_much_of_its_coefficient() -> None:
    def fifth_power(state: Floats, p: float, q: float) -> list[float]:
        x, y = state.tolist()
        return [-(1.0 + p) * x + q * x**3 + 1e3 * x**5, 0.3 * y]

    ranges = ((-0.5, 0.5), (-1.0, 1.0))
    rows = curve_of("PD", fifth_power, [0.0, 0.0], (0.0, -0.5), ranges)
    (row,) = [row for row in rows if row.label == "GPD"]
    # x^5 leaves 0.09 between two distances, and nothing of what is extrapolated from them
    assert row.orbit.values == pytest.approx((0.0, 0.0), abs=1e-4)
    assert row.orbit.criticality[1] == pytest.approx(0.75 * 1.25 * 1e3 * 1e-4, rel=1e-2)


def test_no_doubling_is_generalised_where_noise_alone_has_a_cubic_coefficient() -> None:
    ranges = ((-0.15, 0.5), (0.0999, 0.3))
    rows = curve_of("PD", linear_but_for_noise, [0.0, 0.0], (-0.1, 0.1), ranges)
    signs = {row.orbit.criticality[0] > 0.0 for row in rows}
    assert signs == {True, False}
    assert not special(rows, "PD")


def test_a_curve_ends_where_its_first_parameter_leaves_its_range() -> None:
    rows = curve_of("PD", henon, [0.7, 0.7], (0.3675, 0.3), ((0.1, 1.0), (-0.9, 0.9)))
    assert [rows[0].note, rows[-1].note] == ["end of the range"] * 2
    assert [rows[0].orbit.value, rows[-1].orbit.value] == pytest.approx([1.0, 0.1], rel=1e-14)
    assert all(0.1 <= row.orbit.value <= 1.0 for row in rows)


def test_grazing_is_followed_on_the_side_without_the_impact_although_the_other_is_a_root() -> None:
    rows = curve_of(
        "GR",
        touching,
        [0.4, 0.1],
        (0.2, 0.2),
        ((0.0, 1.0), (-0.5, 0.5)),
        impacts=strikes,
        nearest=nearness,
    )
    assert all(row.orbit.onsets == 0 for row in rows)

    def known(q: float) -> float:
        return 0.5 * math.sqrt(1.0 - 0.3 * q - q * q / 0.7)

    known_within_errors(rows, known)
    assert len(rows) < 100


def test_a_curve_that_cannot_be_followed_further_says_where_in_both_parameters_and_why() -> None:
    def hidden(state: Floats, p: float, q: float) -> float:
        return nearness(state, p, q) if q < 0.3 else math.nan

    rows = curve_of(
        "GR",
        touching,
        [0.4, 0.1],
        (0.2, 0.2),
        ((0.0, 1.0), (0.1, 0.5)),
        impacts=strikes,
        nearest=hidden,
    )
    p, q = rows[-1].orbit.values
    assert rows[-1].label == "MX"
    assert q == pytest.approx(0.3, abs=1e-4)
    assert rows[-1].note.startswith(f"lost at {p:.9g}, {q:.9g}, because ")
    assert "; try a smaller tolerance" in rows[-1].note
