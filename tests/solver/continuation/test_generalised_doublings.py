"""Period doublings that turn from soft to hard: a mass on a string whose tension swings."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from benchmarks.basin_scenes import along_the_slide, shaking, sliding
from benchmarks.known_orbits import followed
from benchmarks.limit_cycles import SHARP, SPRING
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch

DAMPING, CUBE = 0.1, 1.0
"""N s/m and N/m^3 of x'' = -DAMPING x' - stiffness x - CUBE x^3 - pull cos(t) x / sqrt(1 + x^2)."""
PULLS = (0.05, 0.2)


def on_a_string(stiffness: float) -> dict[str, Any]:
    """Return the mass, whose string goes to a post 1 m aside; where it is at rest it may stay."""
    string = shaking(1.0) | {"type": "tension", "first": "ground.post"}
    del string["direction"]
    cube = along_the_slide([0.0, 0.0, 0.0, -CUBE])
    scene = sliding("on-a-string", DAMPING, spring=SPRING, cube=cube, string=string)
    scene["ground"] = {"points": scene["ground"]["points"] | {"post": [0.0, -1.0]}}
    declared = {
        "pull": ("N", PULLS[0], "/forces/string/magnitude"),
        "stiffness": ("N/m", stiffness, "/forces/spring/stiffness"),
    }
    parameters = {
        name: {"help": name, "unit": unit, "default": value, "targets": [{"path": path}]}
        for name, (unit, value, path) in declared.items()
    }
    return scene | {"parameters": parameters}


def branch_job(stiffness: float, **fields: Any) -> dict[str, Any]:
    values = dict(zip(("from", "to", "count"), (*PULLS, 12), strict=True))
    job = {"scene": on_a_string(stiffness), "parameter": "pull", "values": values, "settle": 1}
    return job | {"largest_step": 0.2} | fields


def after_a_period(stiffness: float, pull: float, start: Floats) -> Floats:
    """Return state and what the cubes add to it, (4,), of motions so small that these are alone."""

    def slope(t: float, y: Any) -> list[float]:
        wave = pull * math.cos(t)
        back, cube = stiffness + wave, CUBE - 0.5 * wave
        return [
            y[1],
            -DAMPING * y[1] - back * y[0],
            y[3],
            -DAMPING * y[3] - back * y[2] - cube * y[0] ** 3,
        ]

    found = solve_ivp(slope, (0.0, 2.0 * math.pi), [*start, 0.0, 0.0], **SHARP)
    return np.asarray(found.y[:, -1])


def known_doubling(stiffness: float) -> tuple[float, float]:
    """Return the pull at which the mass at rest doubles its period, N, and what cubes add then."""

    def monodromy(pull: float) -> Floats:
        return np.array([after_a_period(stiffness, pull, unit)[:2] for unit in np.eye(2)]).T

    pull = brentq(lambda one: np.linalg.det(monodromy(one) + np.eye(2)), *PULLS, xtol=1e-12)
    matrix = monodromy(pull) + np.eye(2)
    left, right = np.array([-matrix[1, 0], matrix[0, 0]]), np.array([-matrix[0, 1], matrix[0, 0]])
    added = after_a_period(stiffness, pull, right)[2:]
    return pull, float(np.sum(left * added) / np.sum(left * right))


@cache
def doubled(stiffness: float) -> list[Branch]:
    return followed(branch_job(stiffness, doublings=1))


def test_a_string_doubles_softly_up_to_where_cubes_add_nothing() -> None:
    values = {"from": 0.24, "to": 0.26, "count": 6}
    second = {"parameter": "stiffness", "values": values, "labels": ["PD"], "curves": 1}
    _, curve = followed(branch_job(0.25, second=second))
    (found,) = [one for one in curve.special if one.label == "GPD"]
    stiffness = brentq(lambda one: known_doubling(one)[1], 0.248, 0.2495, xtol=1e-8)
    # runs of 1e-11 m know the cubes of motions of 1e-5 m to 1e-5
    assert found.second == pytest.approx(stiffness, abs=5e-6)
    assert found.value == pytest.approx(known_doubling(stiffness)[0], abs=1e-8)
    assert found.second_bound is not None
    assert found.second_bound < 1e-5
    assert found.note == "period doubling is soft on the side of the start, hard beyond"


@pytest.mark.parametrize(("stiffness", "sense"), [(0.26, 1.0), (0.24, -1.0)])
def test_orbits_of_twice_the_period_are_stable_where_doubling_is_soft(
    stiffness: float, sense: float
) -> None:
    first, behind = doubled(stiffness)
    (doubling,) = [one for one in first.special if one.label == "PD"]
    assert (behind.column("unstable")[:3] == float(sense < 0.0)).all()
    # farther on, the branch behind a hard doubling folds back
    assert (sense * (behind.column("value")[1:4] - doubling.value) > 0.0).all()
