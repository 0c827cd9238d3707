"""Motions that are small beside what counts as one, where that is no clearance."""

from typing import Any

import numpy as np
import pytest

from benchmarks.basin_scenes import ON_THE_MASS, cubic_oscillator, shaking, sliding
from jointplay.local import run
from jointplay.records.branch import branches
from jointplay.solver.nonlinear.recurrence import moves_within
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.indicators import Sections, indicators_of

COUNT = 60


def logistic(growth: float) -> Any:
    """Return (COUNT,) iterates of x -> growth x (1 - x) behind a transient."""
    x = [0.3]
    for _ in range(500 + COUNT):
        x.append(growth * x[-1] * (1.0 - x[-1]))
    return np.array(x[-COUNT:])


def two_wells(size: float, push: float) -> dict[str, Any]:
    """Return u'' = -0.2 u' + u - u^3 + push cos(t), of u in so many metres."""
    scene = cubic_oscillator(0.2, -1.0, shaking=shaking(push * size))
    scene["forces"]["spring"]["course"]["coefficients"][3] = -1.0 / size**2
    return scene | {"start": {"points": {"mass.centre": [size, 0.0]}}}


@pytest.mark.parametrize(
    ("size", "push", "verdict"),
    [(1.0, 0.3, "undecided"), (1e-4, 0.3, "undecided"), (1e-4, 0.1, "periodic")],
)
def test_a_small_motion_is_not_periodic_for_being_small(size, push, verdict):
    """At 0.3 it is chaotic: its exponent is 0.15 1/s at sizes of 1 m and of 1 mm."""
    job = {"kind": "poincare", "scene": two_wells(size, push), "settle": 60, "record": COUNT}
    study = run(job | {"indicators": ["recurrence"]}, processes=1).study()
    assert study.verdict_names[study.verdicts[0]] == verdict
    if size < 1.0 and push == 0.3:
        assert "move in no order" in study.reasons[0]
    assert "less than 0.001 of 1 m, as there is no link, or of its own range" in study.reasons[0]


@pytest.mark.parametrize(
    ("motion", "moves"),
    [
        (8e-4 * logistic(3.9), True),
        (8e-4 * logistic(3.2), False),  # of period 2
        (4e-4 * 0.9 ** np.arange(COUNT) * np.cos(np.arange(COUNT)), False),
        (4e-4 * np.cos(np.arange(COUNT)), True),
        (2e-5 * logistic(3.9), False),  # noise
    ],
)
def test_what_moves_in_no_order_and_does_not_fade_is_no_orbit(motion, moves):
    states = np.column_stack([motion, np.roll(motion, 1)])[1:]
    assert moves_within(states, 1e-3) == moves
    for measured in (True, False):
        sections = Sections(states, np.ones(2), np.zeros(2, np.bool_), 1, 1.0, measured)
        _, verdict = indicators_of(("recurrence",), sections, np.zeros(0), np.zeros(0), 1.0, 0)
        undecided = moves and not measured
        assert verdict.code == VERDICTS["undecided" if undecided else "periodic"]


def test_a_scene_says_how_long_its_motions_are():
    job = {"kind": "poincare", "settle": 60, "record": COUNT, "indicators": ["recurrence"]}
    found = []
    for size in (1.0, 1e-4):
        scene = two_wells(size, 0.3) | {"length": size}
        study = run(job | {"scene": scene}, processes=1).study()
        found.append((study.indicators["period"][0], study.verdict_names[study.verdicts[0]]))
        assert f"the scene's length of {size:g} m" in study.reasons[0]
    assert found == [(0.0, "undecided")] * 2


@pytest.mark.parametrize(("length", "shares"), [(None, [1.0]), (1e-4, [0.5, 0.5])])
def test_wells_that_are_close_are_apart_beside_the_length_of_a_scene(length, shares):
    """Each of two wells, 0.2 mm apart, takes half of starts that mirror each other."""
    scene = two_wells(1e-4, 0.1) | ({"length": length} if length else {})
    del scene["forces"]["shaking"]
    job = {
        "kind": "basins",
        "scene": scene | {"period": 2.0 * np.pi},
        "along": {"start": "/start/points/mass.centre/0", "values": [-2e-4, -1e-4, 1e-4, 2e-4]},
        "by": {"start": "/start/velocities/mass/0", "values": [-3e-5, 3e-5]},
        "section": {"channel": "mass.vx", "value": 0.0},
        "indicators": ["recurrence"],
        "settle": 60,
        "record": 4,
    }
    (found,) = [run(job, processes=1).attractors]
    assert [one["share"] for one in found["attractors"]] == shares


@pytest.mark.parametrize(("length", "verdict"), [(None, "equilibrium"), (1e-5, "periodic")])
def test_a_small_limit_cycle_is_no_rest_beside_the_length_of_a_scene(length, verdict):
    """Rayleigh's oscillator, of 0.02 mm: its period is that of Van der Pol's."""
    size = 1e-5
    push = {
        "type": "force",
        **ON_THE_MASS,
        "magnitude": 1.0,
        "direction": [1.0, 0.0],
        "over": {"quantity": "x", "rate": True},
        "course": {"type": "polynomial", "coefficients": [0.0, 1.0, 0.0, -1.0 / 3.0 / size**2]},
    }
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": 1.0}
    scene = sliding("rayleigh", 1e-13, spring=spring, push=push)
    scene |= {"start": {"points": {"mass.centre": [size, 0.0]}}, "length": length}
    job = {"kind": "poincare", "scene": scene, "settle": 20, "record": 12}
    job |= {"section": {"channel": "mass.x", "value": 0.0}, "indicators": ["recurrence"]}
    study = run(job, processes=1).study()
    assert study.verdict_names[study.verdicts[0]] == verdict
    assert np.diff(study.section_times()[0]) == pytest.approx(6.66328685932, abs=1e-7)


FOLD = 1.7797195
"""rad/s: where large swings of u'' = -0.1 u' - u - u^3 + 0.3 cos(w t) end. SciPy's DOP853 shoots at
orbits at 1.7794 and 1.77965; there the square of the product of 1 - multiplier falls to zero."""


@pytest.mark.parametrize("length", [None, 1e-6])
def test_a_branch_of_small_orbits_has_its_fold_beside_the_length_of_a_scene(length):
    size = 1e-6
    scene = cubic_oscillator(0.1, 1.0, shaking=shaking(0.3 * size, 1.6))
    scene["forces"]["spring"]["course"]["coefficients"][3] = -1.0 / size**2
    frequency = {"path": "/forces/shaking/course/frequency"}
    scene["parameters"] = {
        "frequency": {"help": "Of the shaking.", "unit": "rad/s", "targets": [frequency]}
    }
    scene |= {"start": {"points": {"mass.centre": [1.5 * size, 0.0]}}, "length": length}
    job = {"kind": "continuation", "scene": scene, "parameter": "frequency", "settle": 80}
    (branch,) = branches(
        run(job | {"values": {"from": 1.6, "to": 2.2, "count": 24}}, processes=1).study()
    )
    folds = [one.value for one in branch.special if one.label == "LP"]
    assert folds == pytest.approx([] if length is None else [FOLD], abs=2e-7)
