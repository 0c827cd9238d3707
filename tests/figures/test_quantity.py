"""Axes show SI prefixes instead of powers of ten."""

import numpy as np
import pytest

from jointplay.figures.quantity import scale


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [
        ("m", 0.528, "m"),
        ("m", 5e-4, "mm"),
        ("m", 5e-5, "µm"),
        ("m", 3e4, "m"),
        ("m/s", 0.02, "mm/s"),
        ("m/s^2", 592.9, "m/s²"),
        ("m/s^2", 2.2e5, "km/s²"),
        ("N", 1569.0, "N"),
        ("N", 2.5e5, "kN"),
        ("N m", 4e6, "MN·m"),
        ("rad/s", 3.14, "rad/s"),
        ("rad/s^2", 1e7, "rad/s²"),
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


def test_what_is_no_number_does_not_choose_the_unit():
    assert scale("m", np.array([np.nan, np.inf, 2e-4])).unit == "mm"
