"""Rotation numbers of curves whose rotation is known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.nonlinear.rotation import rotation_number
from tests.solver.nonlinear.exponents import agrees
from tests.solver.nonlinear.textbook import (
    CAT,
    HENON,
    circle,
    delayed_logistic,
    logistic,
    ueda_section,
)

GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


def curve(turns: np.ndarray) -> np.ndarray:
    """A bent, tilted curve with axes of very different size: 1 mm by 5 m/s."""
    angle = 2.0 * math.pi * turns
    return np.column_stack(
        [1e-3 * (np.cos(angle) + 0.2 * np.cos(2.0 * angle)), 5.0 * np.sin(angle + 0.3)]
    )


@pytest.mark.parametrize("rotation", [GOLDEN, math.sqrt(2.0) - 1.0, 0.1234, 1.0 - 0.1234, 0.02])
@pytest.mark.parametrize("bend", [0.0, 0.5, 0.9])
def test_uneven_turning_has_the_rotation_number_of_the_even_one(
    rotation: float, bend: float
) -> None:
    found = rotation_number(curve(circle(rotation, bend).orbit(1000)[:, 0]))
    assert found is not None
    assert abs(found.value - rotation) <= found.error
    assert found.error < 1e-4


def test_the_error_falls_faster_than_any_power() -> None:
    def error(count: int) -> float:
        found = rotation_number(curve(circle(GOLDEN, 0.5).orbit(count)[:, 0]))
        assert found is not None
        assert abs(found.value - GOLDEN) <= found.error
        return found.error

    errors = [error(count) for count in (60, 240, 960)]
    assert errors[0] / errors[1] > 4.0**4
    assert errors[1] / errors[2] > 4.0**6


def test_single_advances_may_exceed_half_a_turn() -> None:
    """Advances lie on both sides of half a turn: counted from -1/2 to 1/2 the mean is wrong."""
    turns = circle(0.45, 0.97).orbit(1000)[:, 0]
    x, y = curve(turns).T
    advances = np.diff(np.arctan2(y - y.mean(), 1e3 * (x - x.mean()))) / (2.0 * math.pi)
    assert np.abs(advances % 1.0 - 0.5).min() < 0.02
    turns = circle(0.5 * GOLDEN + 0.15, 0.97).orbit(1000)[:, 0]
    found = rotation_number(curve(turns))
    assert found is not None
    assert agrees(found, 0.5 * GOLDEN + 0.15)


def test_a_mirrored_curve_turns_the_other_way() -> None:
    section = curve(circle(GOLDEN, 0.5).orbit(400)[:, 0])
    found = rotation_number(section * [1.0, -1.0])
    assert found is not None
    assert agrees(found, 1.0 - GOLDEN)


def test_a_closed_curve_born_from_a_fixed_point_turns_like_its_multipliers() -> None:
    """At r = 2 the multipliers of the delayed logistic map are exp(±iπ/3): a sixth of a turn."""
    found = rotation_number(delayed_logistic(2.001).orbit(2000, 20_000))
    assert found is not None
    assert found.value == pytest.approx(1.0 / 6.0, abs=1e-3)  # moves in proportion to r - 2
    assert found.error < 1e-7


def test_every_second_point_of_a_torus_in_two_pieces_lies_on_one_curve() -> None:
    turns = circle(GOLDEN, 0.5).orbit(1000)[:, 0]
    pieces = curve(turns) + np.where(np.arange(1000) % 2, 1.0, -1.0)[:, None] * [4e-3, 0.0]
    assert rotation_number(pieces) is None
    found = rotation_number(pieces[::2])
    assert found is not None
    assert agrees(found, 2.0 * GOLDEN % 1.0)


NO_CLOSED_CURVES = {
    "Hénon": HENON.orbit(1000, 100),
    "cat": CAT.orbit(1000),
    "Duffing": ueda_section(),
    "noise": np.random.default_rng(0).standard_normal((1000, 2)),
    "line": np.repeat(logistic(3.9).orbit(500), 2, axis=1),
    "period 5": np.tile(curve(np.arange(5.0) / 5.0), (40, 1)),
    "point": np.zeros((100, 2)),
    "31 points": curve(circle(GOLDEN, 0.5).orbit(31)[:, 0]),
    "figure eight": np.column_stack([np.sin(0.3 * k * np.arange(600.0)) for k in (1, 2)]),
}


@pytest.mark.parametrize("name", NO_CLOSED_CURVES)
def test_what_is_no_closed_curve_has_no_rotation_number(name: str) -> None:
    assert rotation_number(NO_CLOSED_CURVES[name]) is None


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match=r"points \(n, 2\) in a plane"):
        rotation_number(np.zeros((100, 3)))
    with pytest.raises(ValueError, match="finite points"):
        rotation_number(np.full((100, 2), math.nan))


@settings(max_examples=40)
@given(
    st.floats(0.3, 3.0),
    st.floats(-1.0, 1.0),
    st.floats(1e-4, 1e4),
    st.floats(-10.0, 10.0),
    st.floats(0.0, 2.0 * math.pi),
)
def test_affine_changes_of_the_plane_do_not_matter(
    stretch: float, shear: float, unit: float, shift: float, turned: float
) -> None:
    section = curve(circle(GOLDEN, 0.5).orbit(300)[:, 0]) * [1e3, 0.2]
    c, s = math.cos(turned), math.sin(turned)
    change = unit * np.array([[c, -s], [s, c]]) @ np.array([[stretch, shear], [0.0, 1.0]])
    found = rotation_number((section + shift) @ change.T)
    assert found is not None
    assert agrees(found, GOLDEN)
    assert found.error < 1e-6
