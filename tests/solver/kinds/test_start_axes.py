"""Axes of maps that are numbers of the start: what they are called, and what is refused."""

import pytest

from benchmarks.basin_scenes import cubic_oscillator, shaking
from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit, parse
from jointplay.solver.mechanics.start.given import Taken
from jointplay.solver.runs.study.held_starts import concerns
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.scene import presets

PLACE = "/start/joints/stop/eccentricity/0"
RATE = "/start/joints/stop/rate/0"
OSCILLATOR = {"preset": "impact-oscillator", "parameters": {"speed": 28.0}}


def chart(scene=OSCILLATOR, along=PLACE, by=RATE, xs=(0.18, 0.19), ys=(-0.1, 0.2), **fields):
    return {
        "kind": "chart",
        "scene": scene,
        "along": {"start": along, "values": [*xs]},
        "by": {"start": by, "values": [*ys]},
        "settle": 2,
        "record": 4,
        "indicators": ["recurrence"],
        "tolerance": 1e-6,
    } | fields


def ends(study):
    found = {}
    for block in range(len(study.blocks)):
        for piece in StudyRun(study, block).slices():
            found |= {tuple(study.values[end.point]): end for end in piece.ended}
    return found


def problems(document):
    with pytest.raises(InvalidInput) as refused:
        admit(document)
    return [(one.pointer, one.detail) for one in refused.value.problems]


def test_numbers_of_the_start_have_names_units_and_scenes():
    study = admit(chart())
    assert study.parameters == ("stop.eccentricity_rate_x", "stop.eccentricity_x")
    assert study.parameter_units == ("m/s", "m")
    assert "stop.eccentricity_x" not in study.job["scene"]["parameters"]
    assert parse(study.job).digest == study.digest
    starts = {
        (start.rate[0], start.eccentricity[0])
        for start in (study.point_scene(point).start.joints["stop"] for point in range(4))
    }
    assert starts == {(rate, place) for rate in (-0.1, 0.2) for place in (0.18, 0.19)}


def test_a_point_has_the_bits_of_a_scene_that_starts_there():
    study = admit(chart())
    document = presets.document("impact-oscillator") | {
        "start": {"joints": {"stop": {"eccentricity": [0.18, 0.0], "rate": [0.2, 0.0]}}}
    }
    document["drivers"]["motor"]["speed"] = 28.0
    document["parameters"]["speed"]["default"] = 28.0
    alone = {"settle": 2, "record": 4, "indicators": ["recurrence"], "tolerance": 1e-6}
    (end,) = ends(admit(alone | {"kind": "poincare", "scene": document})).values()
    found = ends(study)[0.2, 0.18]
    assert found.statistics["steps"] == end.statistics["steps"]
    assert found.time == end.time


def test_a_place_of_a_body_is_that_of_one_of_its_points():
    """Without a driver, a joint with play or a guide, this is where a slide starts."""
    place = "/start/points/mass.centre/0"
    study = admit(
        chart(
            cubic_oscillator(shaking=shaking(0.2)),
            place,
            xs=(0.5, -0.25),
            ys=(0.0,),
            by="/start/velocities/mass/0",
        )
    )
    assert study.parameters[1] == "mass.centre.position_x"
    assert study.parameter_units[1] == "m"
    starts = [study.point_scene(point).start.points["mass.centre"] for point in range(2)]
    assert sorted(starts) == [[-0.25, 0.0], [0.5, 0.0]]
    assert not any(end.code for end in ends(study).values())


def test_a_phase_moves_the_driver():
    study = admit(chart(along="/drivers/motor/position", xs=(0.0, 1.5)))
    assert study.parameters[1] == "motor.position"
    assert study.parameter_units[1] == "rad"
    assert {study.point_scene(point).drivers["motor"].position for point in range(4)} == {0.0, 1.5}


def test_a_point_whose_joints_do_not_allow_its_start_fails_by_itself():
    """The pin's rate along the guide is the only one that the mass can have."""
    study = admit(chart(by="/start/velocities/mass/1", ys=(0.0,)))
    assert not any(end.code for end in ends(study).values())
    study = admit(chart(by="/start/velocities/mass/1", ys=(0.0, 0.3)))
    found = ends(study)
    assert {place[0]: end.code for place, end in found.items()} == {0.0: "", 0.3: "start-not-held"}
    assert "/start/velocities/mass" in next(end.detail for end in found.values() if end.code)


@pytest.mark.parametrize(
    ("along", "pointer", "words"),
    [
        ("/start/joints/stopp/eccentricity/0", "/along/start", "There is no joint 'stopp'"),
        ("/start/points/mas.centre/0", "/along/start", "There is no body 'mas'"),
        ("/start/points/mass.center/0", "/along/start", "did you mean 'mass.centre'"),
        ("/start/angles/wheel", "/along/start", "There is no body 'wheel'"),
        ("/drivers/engine/position", "/along/start", "There is no driver 'engine'"),
        ("/bodies/mass/mass", "/along/start", "must lead to a number of the start"),
        ("/start/joints/stop/eccentricity/2", "/along/start", ""),
        (RATE, "/by/start", "let another parameter vary"),
    ],
)
def test_what_is_no_number_of_the_start_is_refused(along, pointer, words):
    assert any(
        place == pointer and words in detail for place, detail in problems(chart(along=along))
    )


def test_an_axis_has_a_parameter_or_a_number_of_the_start():
    both = {"parameter": "speed", "start": PLACE, "values": [1.0, 2.0]}
    ((pointer, detail),) = problems(chart() | {"along": both})
    assert pointer == "/along/parameter"
    assert "does not go with the others" in detail
    ((pointer, detail),) = problems(chart() | {"along": {"values": [1.0]}})
    assert (pointer, "is required" in detail) == ("/along/parameter", True)


def test_a_place_that_begins_like_another_has_its_own_number():
    """A rate that `mass` cannot have says nothing of a body that is called `mass2`."""
    given = Taken("/start/velocities/mass", "m/s", (0.0, 0.3), (0.0, 0.0), 0.3)
    assert concerns(given, "/start/velocities/mass/1")
    assert not concerns(given, "/start/velocities/mass2/1")


def test_a_block_of_points_that_cannot_start_ends():
    found = ends(admit(chart(by="/start/velocities/mass/1", ys=(0.2, 0.3, 0.4))))
    assert [end.code for end in found.values()] == ["start-not-held"] * 6


def test_a_chain_goes_on_behind_a_point_that_cannot_start():
    """The next point begins as its scene says, as behind any point that failed."""
    document = presets.document("impact-oscillator")
    document["start"] = document["start"] | {"velocities": {"mass": [0.0, 0.0]}}
    target = {"path": "/start/velocities/mass/1", "factor": 1.0}
    across = {"help": "Rate across the guide.", "unit": "m/s", "targets": [target]}
    document["parameters"] = document["parameters"] | {"across": across}
    job = {
        "kind": "bifurcation",
        "scene": document,
        "parameter": "across",
        "values": [0.3, 0.2, 0.0],
        "continuation": "forward",
        "chains": 1,
        "settle": 1,
        "record": 2,
        "tolerance": 1e-6,
    }
    study = admit(job)
    found = {}
    for piece in StudyRun(study, 0).slices():
        found |= {end.point: end for end in piece.ended}
    assert [found[k].code for k in range(3)] == ["start-not-held", "start-not-held", ""]


def test_maps_of_more_numbers_than_can_be_read_are_refused_and_told_what_fits():
    job = chart(channels=["*"], statistics=["mean"])
    job["along"] = {"start": PLACE, "values": {"from": 0.17, "to": 0.2, "count": 2000}}
    job["by"] = {"start": RATE, "values": {"from": -0.5, "to": 0.5, "count": 1000}}
    with pytest.raises(LimitExceeded, match=r"such points fit") as refused:
        admit(job)
    assert refused.value.problems[0].pointer == "/by/values"
