"""Curves of special orbits over two parameters, of maps where they are known exactly."""

import math

import numpy as np
import pytest

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


def bogdanov(state: Floats, p: float, q: float) -> list[float]:
    x, y = state.tolist()
    y = y + q * y + p + x * x
    return [x + y, y]


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


def test_resonances_are_named_where_a_second_multiplier_comes_to_the_same_place() -> None:
    folds = curve_of("LP", bogdanov, [0.1, 0.0], (-0.01, 0.2), ((-1.0, 1.0), (-0.4, 0.4)))
    assert special(folds, "LP") == [("R1", pytest.approx((0.0, 0.0), abs=1e-7))]
    doublings = curve_of(
        "PD", of_trace_and_determinant, [0.0, 0.0], (-1.5, 0.5), ((-3.0, 0.0), (0.2, 1.4))
    )
    assert special(doublings, "PD") == [("R2", pytest.approx((-2.0, 1.0), abs=1e-7))]


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
