"""Section maps and their derivatives, against closed forms and against themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from jointplay.solver.continuation.multipliers import spread
from jointplay.solver.continuation.orbit import BAR, Orbit
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.continuation.start import first_orbit
from tests.solver.continuation.oscillator import (
    DAMPING,
    GAP,
    SHAKEN,
    STIFFNESS,
    curve,
    free_multipliers,
)


def orbit_at(speed: float, stop: float = 1e12, periods: int = 1) -> Orbit:
    found, section = curve(stop, speed, periods)
    return first_orbit(found, section)


def test_multipliers_of_a_motion_without_impacts_are_those_in_closed_form() -> None:
    orbit = orbit_at(33.0)
    assert orbit.onsets == 0
    found = orbit.multipliers[:2].tolist()
    assert found == [pytest.approx(one, abs=1e-8) for one in free_multipliers(33.0)]
    assert orbit.error < 1e-7


def test_an_impact_takes_the_square_of_its_restitution_from_the_product_of_multipliers() -> None:
    orbit = orbit_at(25.0)
    assert orbit.onsets == 1
    product = float(np.prod(orbit.multipliers[:2]).real)
    assert product == pytest.approx(0.64 * math.exp(-DAMPING * 2.0 * math.pi / 25.0), rel=2e-4)
    # Newton's law of impact has 0.06918 and 0.61836; a stop that gives way a little differs by that
    assert orbit.multipliers[0] == pytest.approx(0.06918 + 0.61836j, abs=1e-3)


def test_bars_cover_what_runs_err_by_where_differences_at_two_scales_say_too_little() -> None:
    found, section = curve(1e8, 25.0)
    sharp = first_orbit(found, section)
    # runs of both scales take the same steps here, and err alike
    rough = first_orbit(replace(found, map=replace(found.map, tolerance=1e-7)), section)
    away = spread(rough.multipliers, sharp.multipliers)
    assert BAR * rough.error < 0.1 * away
    assert away <= rough.bar < 100.0 * away
    assert sharp.bar < 1e-7


def test_an_orbit_tells_its_gap_or_the_speed_of_its_impact_as_closed_forms_have_them() -> None:
    free = orbit_at(33.0).looser.passage.margins
    response = abs(1.0 / complex(STIFFNESS - 33.0**2, 33.0 * DAMPING))
    assert free.gap == pytest.approx(GAP - SHAKEN * response, abs=1e-10)
    assert np.isnan([free.speed, free.penetration]).all()
    struck = orbit_at(25.0).looser.passage.margins
    # of a rigid stop; this one gives way a little
    assert struck.speed == pytest.approx(0.2851232770, abs=2e-4)
    assert np.isnan([struck.gap, struck.penetration]).all()


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_derivatives_are_differences_at_any_scale(scale: float) -> None:
    orbit = orbit_at(25.0)
    map_, section = orbit.curve.map, orbit.section
    other = map_.linear(section, scale)
    assert np.abs(other.jacobian - orbit.linear.jacobian).max() < 1e-5
    assert np.abs(other.sensitivity - orbit.linear.sensitivity).max() < 1e-7
    assert other.alike


def test_an_orbit_of_the_doubled_map_is_refused_if_it_repeats_before() -> None:
    with pytest.raises(NoStart, match="repeats after 1 of the 2 periods; ask for 'period' 1"):
        orbit_at(25.0, periods=2)


def test_where_no_orbit_is_near_the_residual_is_told() -> None:
    found, section = curve(1e12, 25.0)
    away = Section(25.0, section.state + np.array([-0.3, 40.0, 0.0]))
    with pytest.raises(NoStart, match=r"no orbit of period 1 near .* residual .*Try another"):
        first_orbit(found, away)


def test_runs_that_take_far_longer_than_the_motion_are_given_up() -> None:
    found, section = curve(1e12, 25.0)
    assert 100.0 < found.map.steps < 5000.0
    slow = replace(found.map, steps=0.0, periods=1000)
    (passage,) = slow.passages([section])
    assert passage.failure == "a run beside it takes more than 2e+05 steps"
    (passage,) = replace(found.map, periods=1000).passages([section])
    assert not passage.failure
    assert passage.steps > 220_000
