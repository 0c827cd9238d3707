"""Orbits beside closed forms and simulations that know of no branch."""

from functools import cache

import numpy as np
import pytest

from benchmarks.known_orbits import dry_friction, with_dry_friction
from benchmarks.random_mechanisms import OSCILLATORS
from benchmarks.random_orbits import FAMILIES, compared, orbit_of
from benchmarks.simulated_sections import SimulatedMap
from jointplay.records.branch import Branch
from jointplay.solver.continuation.plan import ContinuationStudy

CHEAP = [*OSCILLATORS, "slider-crank, mass", "slider-crank, play"]
"""One closed loop that is simulated in the other formulation, and one with play and friction."""


def test_dry_friction_slides_as_den_hartog_found_it() -> None:
    # four ramps leave about 1e-11 m of 1 m, their widths to the fourth power
    assert dry_friction() < 1e-9


@cache
def drawn_orbit(family: str) -> tuple[ContinuationStudy, Branch]:
    random = np.random.default_rng(11)
    found = None
    while found is None:
        found = orbit_of(FAMILIES[family](random))
    return found


@pytest.mark.parametrize("family", CHEAP)
def test_multipliers_are_those_of_simulations_beside_the_orbit(family: str) -> None:
    apart, allowed = compared(*drawn_orbit(family))
    assert apart <= allowed < 1e-2


def test_an_orbit_of_joint_coordinates_closes_in_the_other_formulation() -> None:
    study, branch = drawn_orbit("slider-crank, mass")
    columns = {one.name: values for one, values in branch.columns.items()}
    map_ = SimulatedMap.of(study, columns)
    assert map_.formulation == "lagrange"
    end, _ = map_.after(map_.section)
    # speeds are about 1 m/s or rad/s, runs at the tolerance 1e-12
    assert end == pytest.approx(map_.section, abs=1e-11)


def test_bars_hold_where_differences_err_by_more_than_they_part() -> None:
    scene = with_dry_friction(1.1214999325809307, 0.0013524658404446511)
    scene["forces"]["rubbing"]["magnitude"] = 0.19360304122886432
    drawn = {"scene": scene, "parameter": "drive"}
    found = orbit_of(drawn)
    assert found is not None
    apart, allowed = compared(*found)
    assert 1e-8 < apart <= allowed < 1e-6
