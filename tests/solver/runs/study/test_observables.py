"""Channels that a study keeps unless it is told otherwise."""

import copy
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.runs.study.jobs_of_studies import BIFURCATION, SWEEP, study

COORDINATES = [
    *("link2.theta", "link2.omega", "link3.theta", "link3.omega"),
    *("link6.theta", "link6.omega", "slider7.x", "slider7.vx"),
]
QUANTITIES = ("eccentricity_x", "eccentricity_y", "eccentricity_rate_x", "eccentricity_rate_y")
ECCENTRICITIES = [f"{joint}.{quantity}" for joint in "AB" for quantity in QUANTITIES]


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_observables_are_coordinates_and_eccentricities_with_their_rates(formulation: str) -> None:
    found = study(BIFURCATION, formulation=formulation)
    assert sorted(c.name for c in found.observables) == sorted(COORDINATES + ECCENTRICITIES)
    assert found.job["observables"] == [channel.name for channel in found.observables]


def test_a_slider_that_moves_along_y_is_observed_along_y() -> None:
    scene = presets.document("slider-crank")
    scene["joints"]["guide"]["axis"] = [0.3, 1.0]
    scene["start"]["angles"] = {"crank": 1.0, "rod": 1.2, "slider": 0.0}
    found = study(BIFURCATION, scene=scene, values=[5e-4])
    names = [channel.name for channel in found.observables]
    assert {"slider.y", "slider.vy"} <= set(names)
    assert not {"slider.x", "slider.vx"} & set(names)


def test_a_free_body_is_observed_in_all_its_coordinates() -> None:
    scene = {"preset": "bouncing-journal"}
    found = study(BIFURCATION, scene=scene, section={"onset": "bearing"})
    names = {channel.name for channel in found.observables}
    assert {f"journal.{q}" for q in ("x", "y", "theta", "vx", "vy", "omega")} < names


def test_a_sweep_keeps_peaks_of_outputs_and_loads() -> None:
    names = [channel.name for channel in study(SWEEP).channels]
    loads = [f"{joint}.{q}" for joint in "AB" for q in ("penetration", "normal_force")]
    assert sorted(names) == sorted(["displacement", "velocity", "acceleration", *loads])
    assert study(SWEEP).observables == ()


def test_globs_choose_observables() -> None:
    found = study(BIFURCATION, observables=["A.eccentricity_?", "displacement"])
    names = [channel.name for channel in found.observables]
    assert names == ["A.eccentricity_x", "A.eccentricity_y", "displacement"]


def double_pendulum() -> dict[str, Any]:
    """Two links, the second on a joint with clearance: with none it is still a chain."""
    clearance = presets.document("slider-crank")["joints"]["P"]["clearance"]
    link = {"mass": 1.0, "inertia": 0.1, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    path = "/joints/middle/clearance/radial_clearance"
    play = {"help": "Play.", "unit": "m", "default": 1e-3, "targets": [{"path": path}]}
    return {
        "name": "double-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"upper": link, "lower": copy.deepcopy(link)},
        "joints": {
            "top": {"type": "revolute", "bearing": "ground.O", "journal": "upper.a"},
            "middle": {
                "type": "revolute",
                "bearing": "upper.b",
                "journal": "lower.a",
                "clearance": copy.deepcopy(clearance),
            },
        },
        "parameters": {"play": play},
    }


def test_a_channel_that_an_ideal_joint_lacks_is_no_observable_of_the_study() -> None:
    job = {
        "kind": "bifurcation",
        "scene": double_pendulum(),
        "parameter": "play",
        "values": [1e-3, 0.0],
        "section": {"channel": "upper.omega", "value": 0.0},
    }
    found = study(job)
    assert found.structure.tolist() == [0, 1]
    names = {channel.name for channel in found.observables}
    assert {"lower.x", "lower.y", "lower.theta", "upper.theta"} < names
    assert not any("eccentricity" in name for name in names)
    with pytest.raises(InvalidInput) as refused:
        admit({**job, "observables": ["upper.theta", "middle.penetration"]})
    (problem,) = refused.value.problems
    assert problem.pointer == "/observables/1"
    assert "point 1" in problem.detail
