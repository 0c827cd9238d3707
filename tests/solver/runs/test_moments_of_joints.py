"""Euler's law from channels alone: a flat face that its cam pushes, a journal that oil turns."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from tests.solver.completed_runs import Run, run

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
