"""Euler's law from channels alone: cams, journals in oil, pins with play; forces of slides."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from tests.solver.completed_runs import Run, run
from tests.solver.sliders import bead, block, rocker, thrown

CONTACT = {
    "law": "stiffness-and-dissipation",
    "stiffness": {"law": "power", "stiffness": 1e6},
    "dissipation": {"law": "kuwabara-kono", "relaxation_time": 1e-4},
}
FRICTION = {"law": "brown-mcphee", "static_coefficient": 0.3, "kinetic_coefficient": 0.2}
LASH = {"clearance": {"lash": 1e-4, "contact": CONTACT, "friction": FRICTION}}
PINS: dict[str, dict[str, list[float]]] = {
    "cam": {"O": [0.01, 0.0]},
    "arm": {"face": [0.05, -0.01], "pivot": [-0.08, 0.02], "hook": [0.0, 0.05]},
    "ring": {"O": [0.03, 0.0], "C": [-0.02, 0.01]},
    "rotor": {"J": [0.02, 0.01]},
}
INERTIA = 2e-3
SHAKEN = {"type": "sinusoidal", "amplitude": 0.02, "frequency": 20.0}


def body(name: str) -> dict[str, Any]:
    return {"mass": 0.4, "inertia": INERTIA, "points": PINS[name]}


def follower(more: dict[str, Any]) -> dict[str, Any]:
    """Return an arm whose flat face swings on a cam."""
    return {
        "name": "follower",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "V": [-0.13, 0.07], "W": [-0.05, -0.1]}},
        "bodies": {"cam": body("cam"), "arm": body("arm")},
        "joints": {
            "shaft": {"type": "revolute", "bearing": "ground.O", "journal": "cam.O"},
            "hinge": {"type": "revolute", "bearing": "ground.V", "journal": "arm.pivot"},
            "lift": {
                "type": "flat-follower",
                "cam": "cam.O",
                "follower": "arm.face",
                "normal": [0.0, 1.0],
                "profile": {
                    "type": "sinusoidal",
                    "amplitude": 0.004,
                    "frequency": 1.0,
                    "offset": 0.04,
                },
            }
            | more,
        },
        "drivers": {"motor": {"joint": "shaft", "speed": 30.0}},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.W",
                "second": "arm.hook",
                "stiffness": 500.0,
            }
        },
    }


def oiled(law: str) -> dict[str, Any]:
    """Return a rotor on an oiled journal in a ring that is driven."""
    film = {"law": law, "viscosity": 0.1, "boundary_layer": 2e-5}
    play = {"radial_clearance": 2e-4, "bearing_radius": 0.01, "bearing_width": 0.012}
    play |= {"contact": CONTACT | film, "friction": FRICTION}
    return {
        "name": "oiled",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"ring": body("ring"), "rotor": body("rotor")},
        "joints": {
            "shaft": {"type": "revolute", "bearing": "ground.O", "journal": "ring.O"},
            "pin": {
                "type": "revolute",
                "bearing": "ring.C",
                "journal": "rotor.J",
                "clearance": play,
            },
        },
        "drivers": {"motor": {"joint": "shaft", "speed": 40.0}},
    }


def arm(found: Run, reference: str) -> tuple[Floats, Floats]:
    """Return the vector from a body's centre to one of its points, m."""
    name, point = reference.split(".")
    (x, y), angle = PINS[name][point], found[f"{name}.theta"]
    return x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)


def of(found: Run, joint: str, reference: str) -> Floats:
    """Return the moment of a joint's force about the centre of the body of its second point."""
    x, y = arm(found, reference)
    return np.asarray(x * found[f"{joint}.force_y"] - y * found[f"{joint}.force_x"])


@pytest.mark.parametrize("more", [{}, LASH], ids=["ideal", "with a lash"])
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_flat_face_turns_as_its_moment_says(more: dict[str, Any], formulation: str) -> None:
    found = run(follower(more), 0.3, formulation=formulation, tolerance=1e-8)
    x, y = arm(found, "arm.hook")
    dx, dy = found["arm.x"] + x + 0.05, found["arm.y"] + y + 0.1
    spring = -500.0 * (x * dy - y * dx)
    moment = of(found, "hinge", "arm.pivot") + of(found, "lift", "arm.face") + spring
    moment = moment + found["lift.moment"]
    largest = float(np.abs(found["lift.moment"]).max())
    assert largest > 0.01
    np.testing.assert_allclose(INERTIA * found["arm.alpha"], moment, rtol=0, atol=1e-7 * largest)


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_roller_turns_its_arm_by_friction_at_its_own_radius(formulation: str) -> None:
    radius, document = 0.01, follower({"type": "roller-follower", "roller_radius": 0.01} | LASH)
    del document["joints"]["lift"]["normal"]
    found = run(document, 0.1, formulation=formulation, tolerance=1e-8)
    x, y = arm(found, "arm.hook")
    dx, dy = found["arm.x"] + x + 0.05, found["arm.y"] + y + 0.1
    moment = of(found, "hinge", "arm.pivot") + of(found, "lift", "arm.face")
    moment = moment - 500.0 * (x * dy - y * dx) + radius * found["lift.friction_force"]
    largest = radius * float(np.abs(found["lift.friction_force"]).max())
    assert largest > 1e-3
    np.testing.assert_allclose(INERTIA * found["arm.alpha"], moment, rtol=0, atol=1e-7 * largest)
    # the cam, which turns steadily about the origin, feels the opposite at the roller's centre
    (x, y), fx, fy = arm(found, "arm.face"), found["lift.force_x"], found["lift.force_y"]
    load = (found["arm.x"] + x) * fy - (found["arm.y"] + y) * fx
    load = load + radius * found["lift.friction_force"] + 0.4 * 9.81 * found["cam.x"]
    np.testing.assert_allclose(found["motor.torque"], load, rtol=0, atol=1e-7 * largest)


def test_a_pin_turns_its_body_and_that_of_its_slot_by_friction_at_its_own_radius() -> None:
    found = run(bead(), 0.02, tolerance=1e-8)
    turning = 0.01 * (found["slot.wall_1.friction_force"] + found["slot.wall_2.friction_force"])
    assert float(np.abs(turning).max()) > 0.1
    np.testing.assert_allclose(5e-5 * found["bead.alpha"], turning, rtol=0, atol=1e-10)
    found = run(rocker(1e-3), 0.3)  # the slot's body is the first one: it feels the opposite
    turning = 0.01 * (found["slot.wall_1.friction_force"] + found["slot.wall_2.friction_force"])
    x = found["crank.x"] + 0.2 * np.cos(found["crank.theta"]) + 0.5
    y = found["crank.y"] + 0.2 * np.sin(found["crank.theta"])
    moment = -(x * found["slot.force_y"] - y * found["slot.force_x"]) - turning
    moment = moment - 2.0 * 9.81 * 0.3 * np.cos(found["rocker.theta"])
    assert float(np.abs(turning).max()) > 0.1
    inertia = 0.05 + 2.0 * 0.3**2
    np.testing.assert_allclose(inertia * found["rocker.alpha"], moment, rtol=0, atol=1e-8)


@pytest.mark.parametrize(("aside", "side"), [(0.5, 1.0), (-0.5, -1.0)])
def test_friction_against_the_axis_is_positive_at_the_wall_on_its_left(
    aside: float, side: float
) -> None:
    found = run(thrown(block(friction={"coefficient": 0.2}), 2.0, aside), 0.004)
    corners = [f"guide.corner_{k}" for k in ((1, 2) if side > 0.0 else (3, 4))]
    rubbed = sum(found[f"{corner}.friction_force"] for corner in corners)
    pressed = sum(found[f"{corner}.normal_force"] for corner in corners)
    assert float(np.max(pressed)) > 100.0
    np.testing.assert_allclose(rubbed, side * 0.2 * pressed, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found["guide.force_x"], -0.2 * pressed, rtol=1e-9, atol=1e-9)
    assert all((side * found[f"{corner}.slip_velocity"] < -1.0).all() for corner in corners)


@pytest.mark.parametrize("formulation", ["ideal", "reduced", "lagrange"])
def test_the_force_of_a_driven_slide_has_that_of_its_driver_in_it(formulation: str) -> None:
    """A block of 1 kg is shaken along (0.8, 0.6); a pendulum hangs on it, or nothing."""
    document = block()
    document |= {
        "gravity": [0.0, -9.81],
        "drivers": {"motor": {"joint": "guide", "motion": SHAKEN}},
    }
    del document["joints"]["guide"]["clearance"]
    document["joints"]["guide"] |= {"axis": [0.8, 0.6]}
    more: dict[str, Any] = {}
    if formulation != "ideal":
        document["bodies"]["rotor"] = body("rotor")
        pin = {"type": "revolute", "bearing": "block.S", "journal": "rotor.J"}
        document["joints"]["pin"] = pin
        more = {"formulation": formulation}
    found = run(document, 0.2, tolerance=1e-9, **more)
    hung = [found[f"pin.force_{k}"] if more else 0.0 for k in "xy"]
    for k, weight in (("x", 0.0), ("y", 9.81)):
        held = found[f"block.a{k}"] + weight + hung["xy".index(k)]
        np.testing.assert_allclose(found[f"guide.force_{k}"], held, rtol=0, atol=1e-8)
    along = 0.8 * found["guide.force_x"] + 0.6 * found["guide.force_y"]
    np.testing.assert_allclose(found["motor.torque"], along, rtol=0, atol=1e-8)
    assert float(np.ptp(along)) > 1.0


@pytest.mark.parametrize("law", ["short-bearing-film", "long-bearing-film"])
def test_oil_turns_a_journal_as_its_moment_says(law: str) -> None:
    found = run(oiled(law), 0.1, tolerance=1e-8)
    moment = of(found, "pin", "rotor.J") + found["pin.moment"]
    np.testing.assert_allclose(INERTIA * found["rotor.alpha"], moment, rtol=0, atol=1e-12)
    # the ring feels the opposite about the journal's centre, but for what the depth moves friction
    depth = np.maximum(found["pin.penetration"], 0.0) * found["pin.friction_force"]
    ex, ey = found["pin.eccentricity_x"], found["pin.eccentricity_y"]
    fx, fy = found["pin.force_x"], found["pin.force_y"]
    (cx, cy), (ox, oy) = arm(found, "ring.C"), arm(found, "ring.O")
    on_ring = depth - found["pin.moment"] - (ex * fy - ey * fx) - (cx * fy - cy * fx)
    held = ox * found["shaft.force_y"] - oy * found["shaft.force_x"] + found["motor.torque"]
    np.testing.assert_allclose(INERTIA * found["ring.alpha"], on_ring + held, rtol=0, atol=1e-12)
    assert float(np.abs(found["pin.moment"]).max()) > 1e-4


def test_a_journal_without_oil_has_no_moment_after_one_with_it() -> None:
    """Facts of a mechanism are kept by its structure: those of the first one were taken."""
    document = oiled("short-bearing-film")
    assert "pin.moment" in names(document)
    document["joints"]["pin"]["clearance"]["contact"] = CONTACT
    assert "pin.moment" not in names(document)
    assert len(run(document, 1e-3).time) > 1


def names(document: dict[str, Any]) -> list[str]:
    """Return the channels of a scene."""
    return [channel.name for channel in channels(Scene.model_validate(document))]
