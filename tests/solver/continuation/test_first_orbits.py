"""Several orbits that one motion passes: cycles of Hénon's map, a pendulum in chaos."""

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from benchmarks.known_orbits import DRIVEN, NATURAL, pendulum
from jointplay.records.arrays import Floats
from jointplay.records.point import StudySlice
from jointplay.solver.computations import computation_of
from jointplay.solver.continuation.first_orbits import embedded_orbits
from jointplay.solver.continuation.orbit import Curve, Orbit, Scales
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.runs.study.plan import Study
from tests.solver.continuation.known_maps import KnownMap
from tests.solver.continuation.test_branches import admitted, table

STRENGTH = 1.105
"""Strength of the drive at which a pendulum is chaotic (Taylor 2005, Classical Mechanics, 12.5)."""
CHAOS: dict[str, Any] = {
    "kind": "continuation",
    "scene": pendulum(),
    "parameter": "strength",
    "values": {"from": STRENGTH, "to": STRENGTH + 1e-3, "count": 2},
    "tolerance": 1e-12,
}


def henon(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [1.0 - a * x * x + y, 0.3 * x]


@pytest.mark.parametrize(
    ("period", "cycles"), [(1, 2), (2, 1), (3, 0), (4, 1), (5, 0), (6, 2), (7, 4)]
)
def test_cycles_of_henons_map_are_found_each_once(period: int, cycles: int) -> None:
    # their numbers: Biham and Wenzel 1989, Phys. Rev. Lett. 63:819; of the two of period 1, of
    # which x is a root of 1.4 x^2 + 0.7 x - 1, one is beside the attractor
    kernel: Any = SimpleNamespace(states=2, pairs=())
    map_ = KnownMap(kernel, lambda _a: None, period, 1e-13, np.ones(2), 1.0, formula=henon)  # type: ignore[arg-type,return-value]
    curve = Curve(map_, Scales(np.array([2.5, 0.75, 1.0]), np.array([0.5, 0.5, 1.0])))
    with np.errstate(over="ignore", invalid="ignore"):  # it is left at once from afar
        found = embedded_orbits(curve, Section(1.4, np.array([0.1, 0.1])), 8)
    orbits = [one for one in found if isinstance(one, Orbit)]
    lacks = [one for one in found if isinstance(one, NoStart)]
    assert (len(orbits), len(lacks)) == (cycles, 8 - cycles)
    assert f"of period {period} that were found near 257 sections of" in str(lacks[0])
    assert f"the motion: {cycles}. Newton's method started from 64 of them" in str(lacks[0])
    places = []
    for orbit in orbits:
        x, around = orbit.section.state, []
        for _ in range(period):
            around.append(x[0])
            x = np.array(henon(x, 1.4))
        assert x == pytest.approx(orbit.section.state, abs=1e-10)  # tolerance times multiplier
        assert np.abs(np.diff(np.sort(around))).min(initial=1.0) > 1e-3  # no shorter period
        places += around
    assert np.diff(np.sort(places)).min(initial=1.0) > 1e-4
    if period == 1:
        assert sorted(places) == pytest.approx(sorted(np.roots([1.4, 0.7, -1.0])), abs=1e-11)


@cache
def embedded() -> tuple[Study, tuple[StudySlice, ...]]:
    study = admitted(CHAOS | {"orbits": 4, "doublings": 1})
    return study, tuple(computation_of(study, 0).slices())


def later(periods: float, state: Floats) -> Floats:
    """Return angle and rate of the pendulum later, by another integrator."""

    def slope(t: float, y: Floats) -> list[float]:
        drive = STRENGTH * np.cos(DRIVEN * t) - np.sin(y[0])
        return [y[1], NATURAL**2 * drive - 0.5 * NATURAL * y[1]]

    found = solve_ivp(slope, (0.0, periods), state, method="DOP853", rtol=1e-13, atol=1e-13)
    return np.asarray(found.y[:, -1], np.float64)


def apart(one: Floats, other: Floats) -> float:
    """Return how far states are apart but for whole turns."""
    angle, rate = one - other
    return float(np.hypot(angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)), rate))


def test_chaotic_motion_of_a_pendulum_passes_unstable_orbits_and_their_mirror_images() -> None:
    study, slices = embedded()
    ends = [end for one in slices for end in one.ended]
    assert [end.code for end in ends] == ["", "no-orbit", "", "", "no-orbit"]
    assert "no period doubling" in ends[1].detail  # branches behind doublings come first
    assert "Ask for fewer 'orbits'" in ends[4].detail
    tables = [table(list(slices), study, point) for point in (0, 2, 3)]
    places = [(one["state.rod.theta"][0], one["rate.rod.theta"][0]) for one in tables]
    states = [np.array([angle + 0.5 * np.pi, rate]) for angle, rate in places]  # from hanging down
    # tolerances of both are 1e-12 or less of 25 rad/s, and errors grow threefold a period
    for found, state in zip(tables, states, strict=True):
        assert found["unstable"][0] == 1.0
        assert apart(later(1.0, state), state) < 1e-10
        product = found["multiplier_1.real"][0] * found["multiplier_2.real"][0]
        assert product == pytest.approx(np.exp(-0.5 * NATURAL), rel=1e-6)  # noise of differences
    one, other, own = states  # half a period later the mirror image drives on
    assert apart(one, other) > 0.1
    assert apart(later(0.5, one), -other) < 1e-9
    assert apart(later(0.5, own), -own) < 1e-9
