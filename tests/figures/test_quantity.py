"""Axes show SI prefixes instead of powers of ten."""

import numpy as np
import pytest

from jointplay.figures.quantity import alike, scale, showing


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [
        ("m", 0.528, "m"),
        ("m", 5e-4, "mm"),
        ("m", 5e-5, "µm"),
        ("m", 3e4, "10³ m"),
        ("rad", 1e-11, "mrad"),
        ("m/s", 0.02, "mm/s"),
        ("m/s^2", 592.9, "m/s²"),
        ("m/s^2", 2.2e5, "10³ m/s²"),
        ("N", 1569.0, "N"),
        ("N", 2.5e5, "kN"),
        ("N m", 4e6, "MN·m"),
        ("rad/s", 3.14, "rad/s"),
        ("rad/s^2", 1e7, "10⁶ rad/s²"),
        ("m", 0.0, "m"),
        ("m", 1e-30, "nm"),
        ("1", 1e-9, ""),
        ("kg m^2", 1e-9, "kg·m²"),
    ],
)
def test_the_unit_that_is_shown(unit, largest, shown):
    assert scale(unit, np.array([0.0, -largest])).unit == shown


def test_numbers_are_divided_by_what_the_prefix_stands_for():
    millimetres = scale("m", np.array([5e-4]))
    assert 5e-4 / millimetres.factor == pytest.approx(0.5, rel=1e-15)
    assert millimetres.label("eccentricity x") == "eccentricity x [mm]"


def test_a_pure_number_has_no_brackets():
    assert scale("1", np.array([3.0])).label("ratio") == "ratio"


def test_panels_of_like_size_have_one_unit():
    sizes = [("m", 1.04e-4), ("m", 9.6e-5), ("m", 4e-7), ("rad", 9e-5), ("m", np.nan)]
    found = alike([unit for unit, _ in sizes], [np.array([size]) for _, size in sizes])
    assert [one.unit for one in found] == ["mm", "mm", "µm", "mrad", "m"]


def test_what_is_no_number_does_not_choose_the_unit():
    assert scale("m", np.array([np.nan, np.inf, 2e-4])).unit == "mm"


@pytest.mark.parametrize(
    ("asked", "unit", "shown", "one"),
    [
        ("um", "m", "µm", 1e-6),
        ("mN·m", "N m", "mN·m", 1e-3),
        ("deg", "rad", "deg", np.pi / 180.0),
        ("rpm", "rad/s", "rpm", np.pi / 30.0),
        ("mm/s^2", "m/s^2", "mm/s²", 1e-3),
        ("kN", "m", "m", 1.0),
    ],
)
def test_a_unit_that_was_asked_for_is_shown_where_it_fits(asked, unit, shown, one):
    with showing([asked]):
        found = scale(unit, np.array([2.0]))
    assert found.unit == shown
    assert found.factor == pytest.approx(one, rel=1e-15)
    assert scale(unit, np.array([2.0])).unit != "µm"
