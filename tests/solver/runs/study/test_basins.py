"""Basins of the impact oscillator beside the share of starts that keep impacting, known exactly.

Rigid limit, restitution coefficient 0.8, shaken at 28 rad/s: of 100 x 100 starts at the middles of
cells in x -0.02 to 0.01 m from rest and v -0.5 to 0.5 m/s, 0.733 keep impacting (closed-form flow
between impacts).
"""

import numpy as np
import pytest

from jointplay.records.attractor_table import attractor_table
from jointplay.records.attractors import attractors_of
from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset
from jointplay.solver.computations import computation_of
from jointplay.solver.kinds import KINDS, admit
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.scene import presets

IMPACTING = 0.733
OF_GRID = 0.005
"""Uncertainty of that."""


def middles(low, high, count):
    half = (high - low) / count / 2.0
    return {"from": low + half, "to": high - half, "count": count}


def oscillator():
    """Return the oscillator at 28 rad/s, whose stiff stop has exactly the restitution 0.8."""
    document = presets.document("impact-oscillator")
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": 1e11, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": 0.8},
    }
    stop = document["joints"]["stop"]
    clearance = stop["clearance"] | {"contact": contact}
    joints = document["joints"] | {"stop": stop | {"clearance": clearance}}
    drivers = {"motor": document["drivers"]["motor"] | {"speed": 28.0}}
    changed = document | {"joints": joints, "drivers": drivers}
    return {name: part for name, part in changed.items() if name not in ("parameters", "outputs")}


def job(count, **fields):
    return {
        "kind": "basins",
        "scene": oscillator(),
        "along": {
            "start": "/start/joints/stop/eccentricity/0",
            "values": middles(0.17, 0.2, count),
        },
        "by": {"start": "/start/joints/stop/rate/0", "values": middles(-0.5, 0.5, count)},
        "settle": 150,
        "record": 8,
        "tolerance": 1e-6,
        "indicators": ["recurrence"],
    } | fields


def computed(document):
    """Return a study's points in memory."""
    study = admit(document)
    ends = {}
    for block in range(len(study.blocks)):
        for piece in computation_of(study, block).slices():
            ends |= {end.point: end for end in piece.ended}
    in_order = [ends[point] for point in range(study.points)]

    def columns(of):
        return {name: np.array([of(end)[name] for end in in_order]) for name in of(in_order[0])}

    return StudyDataset(
        {"job": study.job, **study.attributes()},
        [Channel(name, "1", "") for name in study.parameters],
        study.values,
        np.array([PointStatus.failed if end.code else PointStatus.done for end in in_order]),
        statistics=columns(lambda end: end.statistics),
        indicators=columns(lambda end: end.indicators),
        verdict_names=tuple(VERDICTS),
        grid=study.shape,
    ), study


@pytest.fixture(scope="module")
def basins():
    return computed(job(16))


def test_the_share_that_keeps_impacting_is_that_of_the_closed_form(basins):
    quiet, impacting = sorted(attractors_of(basins[0]).found, key=lambda one: one.share)
    assert quiet.points + impacting.points == 256
    assert abs(impacting.share - IMPACTING) < 3.0 * np.hypot(impacting.error, OF_GRID)


def test_attractors_are_where_the_closed_form_has_them(basins):
    """The quiet orbit at crank angle 0: x = Re(H a), H = k / (k - w^2 + i c w), from the stop."""
    found, _ = basins
    quiet = min(attractors_of(found).found, key=lambda one: one.share)
    response = 0.005 * 400.0 / (400.0 - 28.0**2 + 2.0j * 28.0)
    position = found.statistics["cycle_mean.mass.s"][quiet.example]
    rate = found.statistics["cycle_mean.mass.s_rate"][quiet.example]
    assert position == pytest.approx(response.real - 0.01, abs=1e-6)  # the tolerance of the steps
    assert rate == pytest.approx(-28.0 * response.imag, abs=1e-4)


def test_outputs_are_those_that_points_have(basins):
    _, study = basins
    told = KINDS["basins"].outputs(study)
    assert {*told} == {
        name for name in basins[0].statistics if name.startswith(("cycle_", "independent_"))
    }
    assert told["cycle_mean.mass.s"][0] == "m"
    assert told["cycle_spread.mass.s_rate"][0] == "m/s"


def test_a_scene_without_joint_coordinates_has_no_basins():
    for changed in ({"formulation": "lagrange"}, {"indicators": ["lyapunov"]}):
        with pytest.raises(InvalidInput, match="Attractors are told apart"):
            admit(job(2, **changed))


def test_a_refined_map_computes_where_attractors_meet_and_has_the_same_labels(basins):
    whole, refined = basins[0], computed(job(16, refine=2))[0]
    own = refined.statistics["inherited"] == 0.0
    assert 1 / 16 < own.mean() < 1 / 2
    for name, values in whole.statistics.items():
        np.testing.assert_array_equal(refined.statistics[name][own], values[own])
    np.testing.assert_array_equal(attractors_of(refined).labels, attractors_of(whole).labels)


def position_without_impacts(speed):
    """Return where the shaken mass is at crank angle 0, from the stop: x = Re(H a) - 10 mm."""
    return (0.005 * 400.0 / (400.0 - speed**2 + 2.0j * speed)).real - 0.01


def over_speed(**fields):
    """Return basins of the oscillator over speeds at which both motions exist, and its position."""
    scene = oscillator() | {
        "parameters": {"speed": {"help": "Of the drive.", "targets": [MOTOR_SPEED]}}
    }
    speeds = {"parameter": "speed", "values": [26.0, 27.0, 28.0, 29.0]}
    return job(6, scene=scene, along=speeds) | fields


MOTOR_SPEED = {"path": "/drivers/motor/speed"}


def test_over_a_parameter_attractors_are_those_of_its_neighbours():
    """The motion without impacts moves by 0.6 to 1.1 mm a speed, and 0.4 mm tell starts apart."""
    found, _ = computed(over_speed())
    labels = attractors_of(found)
    speed = found.values[:, 1]
    quiet = np.abs(found.statistics["cycle_mean.mass.s"] - position_without_impacts(speed)) < 1e-5
    assert {one.name for one in labels.found} == {"period-1 A", "period-1 B"}
    assert len({*labels.labels[quiet]}) == len({*labels.labels[~quiet]}) == 1
    along = attractor_table(found)["along"]
    assert (along["parameter"], along["ended"]) == ("speed", [6, 6, 6, 6])


def test_over_two_parameters_there_are_no_basins():
    scene = over_speed()["scene"]
    parameters = scene["parameters"] | {
        "mass": {"help": "Of the mass.", "targets": [{"path": "/bodies/mass/mass"}]}
    }
    by = {"parameter": "mass", "values": [1.0, 1.1]}
    with pytest.raises(InvalidInput, match="Basins are of starts"):
        admit(over_speed(scene=scene | {"parameters": parameters}, by=by))


@pytest.mark.long
def test_a_fine_map_has_the_share_to_half_a_per_cent():
    impacting = max(attractors_of(computed(job(100))[0]).found, key=lambda one: one.share)
    assert abs(impacting.share - IMPACTING) < OF_GRID
