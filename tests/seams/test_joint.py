"""A type of joint from outside: in scenes, both formulations, figures and on the page by itself."""

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from jointplay.client import Refused
from jointplay.figures import draw_mechanism
from jointplay.records.joint_marks import MARKS
from jointplay.solver.joints import JOINTS
from jointplay.solver.joints.marks import marks
from jointplay.solver.kinds.assembled import assembled_scene
from jointplay.solver.scene.schema import scene_schema
from tests.seams.conftest import Platform
from tests.seams.ring_slot import RingSlot

RADIUS, SPEED, MASS, PLAY = 0.2, 3.0, 1.5, 1e-3
LAW = {"law": "lankarani-nikravesh", "stiffness": 1e8, "exponent": 1.0, "restitution": 0.9}


def circling(velocity: tuple[float, float], **fields: Any) -> dict[str, Any]:
    """Return a job: a disc whose centre is in a ring about the origin begins at its right."""
    ring = {"type": "ring-slot", "hub": "ground.O", "pin": "disc.centre", "radius": RADIUS}
    return {
        "kind": "simulate",
        "scene": {
            "name": "ring",
            "ground": {"points": {"O": [0.0, 0.0]}},
            "bodies": {"disc": {"mass": MASS, "inertia": 0.01, "points": {"centre": [0.0, 0.0]}}},
            "joints": {"ring": ring | fields},
            "start": {
                "points": {"disc.centre": [RADIUS, 0.0]},
                "velocities": {"disc": [*velocity]},
            },
        },
        "duration": 0.3,
        "output_step": 0.001,
        "tolerance": 1e-9,
    }


def loose(**fields: Any) -> dict[str, Any]:
    clearance = {"gap": PLAY, "pin_radius": 0.01, "contact": LAW} | fields
    return {"clearance": clearance}


@pytest.fixture
def ring_slot() -> Iterator[None]:
    JOINTS["ring-slot"] = RingSlot
    MARKS["ring-slot"] = marks(RingSlot)
    yield
    del JOINTS["ring-slot"], MARKS["ring-slot"]


def test_a_joint_that_is_in_no_registry_is_refused_at_its_type(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(circling((0.0, SPEED)))
    (field,) = refused.value.fields
    assert field.pointer == "/scene/joints/ring/type"
    assert "'revolute'" in field.detail


@pytest.mark.usefixtures("ring_slot")
@pytest.mark.parametrize(
    ("fields", "pointer", "words"),
    [
        ({"radius": 0.0}, "/joints/ring/radius", "greater than 0 m"),
        ({"hub": "ground.A"}, "/joints/ring/hub", "point of 'ground'"),
        (loose(pin_radius=0.3), "/joints/ring/clearance/pin_radius", "is smaller"),
        (loose(contact={"law": "goldsmith"}), "/joints/ring/clearance/contact/law", ""),
    ],
)
def test_what_is_wrong_with_it_is_said_at_its_fields(
    platform: Platform, fields: dict[str, Any], pointer: str, words: str
) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(circling((0.0, SPEED), **fields))
    (field,) = refused.value.fields
    assert field.pointer == f"/scene{pointer}"
    assert words in field.detail


@pytest.mark.usefixtures("ring_slot")
def test_it_cannot_be_driven(platform: Platform) -> None:
    document = circling((0.0, SPEED))
    document["scene"]["drivers"] = {"motor": {"joint": "ring", "speed": 1.0}}
    with pytest.raises(Refused) as refused:
        platform.client.submit(document)
    assert "it is a pin in a ring" in refused.value.fields[0].detail


@pytest.mark.usefixtures("ring_slot")
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_without_play_its_body_circles_and_is_pulled_inwards(
    platform: Platform, formulation: str
) -> None:
    job = platform.computed(circling((0.0, SPEED)) | {"formulation": formulation})
    assert job.state == "succeeded"
    names = ["disc.x", "disc.y", "ring.force_x", "ring.force_y"]
    found = job.window(names)
    angle = SPEED / RADIUS * found.time
    x, y = RADIUS * np.cos(angle), RADIUS * np.sin(angle)
    # tolerance 1e-9 a step over some hundred steps, of a length of 0.2 m
    np.testing.assert_allclose(found["disc.x"], x, atol=1e-6)
    np.testing.assert_allclose(found["disc.y"], y, atol=1e-6)
    pull = MASS * SPEED**2 / RADIUS**2
    np.testing.assert_allclose(found["ring.force_x"], -pull * x, atol=1e-3)
    np.testing.assert_allclose(found["ring.force_y"], -pull * y, atol=1e-3)


@pytest.mark.usefixtures("ring_slot")
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_with_play_it_strikes_both_walls_in_turn(platform: Platform, formulation: str) -> None:
    slow = 0.1
    job = platform.computed(circling((slow, 0.0), **loose()) | {"formulation": formulation})
    assert job.state == "succeeded"
    impacts = job.impacts
    outer, inner = (impacts[impacts["joint"] == f"ring.{side}"] for side in ("outer", "inner"))
    # flies from the middle of the play to the wall, and comes back slower over all of it
    assert outer["onset"].iloc[0] == pytest.approx(PLAY / slow, rel=1e-6)
    lasted = outer["release"].iloc[0] - outer["onset"].iloc[0]
    gone = inner["onset"].iloc[0] - outer["release"].iloc[0]
    assert 0.0 < lasted < math.pi / math.sqrt(LAW["stiffness"] / MASS) * 1.1
    assert gone == pytest.approx(2.0 * PLAY / (0.9 * slow), rel=0.05)
    energy = job.statistics["energy"]
    assert abs(energy["residual"]) < 1e-6 * MASS * slow**2


@pytest.mark.usefixtures("ring_slot")
def test_a_study_varies_its_play_and_knows_when_there_is_none(platform: Platform) -> None:
    scene = circling((0.1, 0.0), **loose())["scene"]
    path = {"path": "/joints/ring/clearance/gap"}
    scene["parameters"] = {"gap": {"help": "Play.", "unit": "m", "targets": [path]}}
    gaps = [0.0, PLAY, 2.0 * PLAY]
    sweep = {"kind": "sweep", "grid": {"gap": gaps}, "duration": 0.05, "channels": ["disc.x"]}
    job = platform.computed(sweep | {"scene": scene})
    assert job.state == "succeeded"
    reached = job.study(channels=["disc.x"]).peaks("disc.x").maximum
    # deeper than the wall by at most v sqrt(m / K) = 12 um
    np.testing.assert_allclose(reached, [RADIUS + gap for gap in gaps], rtol=0.0, atol=2e-5)
    assert reached[0] == pytest.approx(RADIUS, abs=1e-12)


@pytest.mark.usefixtures("ring_slot")
def test_figures_draw_its_ring_and_its_pin(platform: Platform) -> None:
    for fields, sign in (({}, "ideal joint"), (loose(), "joint with clearance")):
        job = platform.computed(circling((0.0, SPEED), **fields))
        assert sign in job.figure("mechanism", form="svg").content.decode()
    stored = job.open().attrs
    scene = json.loads(stored["scene"]) | {"curves": json.loads(stored["curves"])}
    (axes,) = draw_mechanism(scene, {"disc": (RADIUS, 0.0, 0.0)}).axes
    (ring,) = (line for line in axes.lines if len(line.get_xdata()) > 100)
    np.testing.assert_allclose(np.hypot(*ring.get_xydata().T), RADIUS, rtol=1e-12)


@pytest.mark.usefixtures("ring_slot")
def test_the_page_draws_them_too(browsing: Any, service_url: str) -> None:
    drawn = "async (asked) => (await import('/page/mechanism/shapes.js')).shapes(...asked)"
    with browsing.page(service_url) as page:
        scene = assembled_scene(circling((0.0, SPEED))["scene"], is_whole=True).drawn()
        shapes = page.evaluate(drawn, [scene, {"disc": [RADIUS, 0.0, 0.0]}])
    (ring,) = (shape["points"] for shape in shapes if len(shape["points"]) > 100)
    np.testing.assert_allclose(np.hypot(*np.array(ring).T), RADIUS, rtol=1e-12)
    discs = [shape["radius"] for shape in shapes if shape["kind"] == "disc"]
    assert len(discs) == 2  # the body and its pin
    assert 4.5 in discs


@pytest.mark.usefixtures("ring_slot")
def test_the_schema_explains_its_fields() -> None:
    definitions = scene_schema()["$defs"]
    assert definitions["RingSlot"]["properties"]["radius"]["unit"] == "m"
    assert definitions["RingClearance"]["properties"]["pin_radius"]["unit"] == "m"
    types = definitions["Scene"] if "Scene" in definitions else scene_schema()
    assert "ring-slot" in str(types["properties"]["joints"])
