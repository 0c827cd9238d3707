"""Mechanisms whose shares of basins are known: published, or counted on a fine grid.

The pendulum, Duffing's oscillator and the oscillator on a belt are those of Stender and Hoffmann
2022, Nonlinear Dyn. 107:1451 (bSTAB), in SI units.
"""

import math
from typing import Any

import numpy as np

from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study

GROUND = {"points": {"O": [0.0, 0.0], "anchor": [-100.0, 0.0]}}
SLIDE = {
    "guide": {
        "type": "prismatic",
        "guide": "ground.O",
        "slider": "mass.centre",
        "axis": [1.0, 0.0],
    }
}
MASS = {"mass": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}}}
ON_THE_MASS = {"first": "ground.O", "second": "mass.centre"}
THIRD = 2.0 * math.pi / 3.0
BELT_SPEED, STICKS = 1.5, 1e-3
"""m/s; the belt's friction grows linearly within the latter of the belt's speed."""


def pendulum() -> dict[str, Any]:
    """Return theta'' = -0.1 theta' + 0.5 - sin(theta): it comes to rest, or turns for ever."""
    ends = {"first": "ground.O", "second": "rod.pivot"}
    return {
        "name": "pushed-pendulum",
        "gravity": [1.0, 0.0],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rod": {"mass": 1.0, "inertia": 1e-12, "points": {"pivot": [-1.0, 0.0]}}},
        "joints": {"pivot": {"type": "revolute", "bearing": "ground.O", "journal": "rod.pivot"}},
        "forces": {
            "push": {"type": "torque", **ends, "moment": 0.5},
            "drag": {"type": "torsion-spring", **ends, "damping": 0.1},
        },
        "parameters": {
            "push": {
                "help": "Torque.",
                "unit": "N m",
                "default": 0.5,
                "targets": [{"path": "/forces/push/moment"}],
            }
        },
    }


def sliding(name: str, damping: float, **forces: Any) -> dict[str, Any]:
    """Return a mass on a slide that is damped, N s/m, and has further forces."""
    damper = {
        "type": "spring-damper",
        "first": "ground.anchor",
        "second": "mass.centre",
        "damping": damping,
    }
    return {
        "name": name,
        "ground": GROUND,
        "bodies": MASS,
        "joints": SLIDE,
        "forces": {"damper": damper, **forces},
    }


def cubic_oscillator(damping: float = 0.08, linear: float = 0.0, **forces: Any) -> dict[str, Any]:
    """Return x'' = -damping x' - linear x - x^3, and further forces on the mass."""
    spring = along_the_slide([0.0, -linear, 0.0, -1.0])
    return sliding("cubic-oscillator", damping, spring=spring, **forces)


def along_the_slide(coefficients: list[float]) -> dict[str, Any]:
    """Return a force on the mass that is a polynomial of its position."""
    return {
        "type": "force",
        **ON_THE_MASS,
        "magnitude": 1.0,
        "direction": [1.0, 0.0],
        "over": {"quantity": "x"},
        "course": {"type": "polynomial", "coefficients": coefficients},
    }


def shaking(magnitude: float, frequency: float = 1.0) -> dict[str, Any]:
    """Return the force magnitude * cos(frequency * t) on the mass."""
    course = {
        "type": "sinusoidal",
        "amplitude": 1.0,
        "frequency": frequency,
        "phase": math.pi / 2.0,
    }
    return {
        "type": "force",
        **ON_THE_MASS,
        "magnitude": magnitude,
        "direction": [1.0, 0.0],
        "course": course,
    }


def duffing() -> dict[str, Any]:
    """Return x'' = -0.08 x' - x^3 + 0.2 cos(t): five attractors."""
    return cubic_oscillator(shaking=shaking(0.2))


def belt() -> dict[str, Any]:
    """Return x'' = -0.1 x' - x + mu(u) sgn(u), u = 1.5 - x', mu(u) = 0.5 (1 + exp(-2 |u|)).

    The mass comes to rest while the belt slides under it, or sticks and slips.
    """
    apart = np.concatenate([[STICKS], np.geomspace(0.05, 6.0, 26)])
    friction = 0.5 + 0.5 * np.exp(-apart / 0.5)
    knots = np.concatenate([BELT_SPEED - apart[::-1], BELT_SPEED + apart])
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": 1.0}
    rubbing = {
        "type": "force",
        **ON_THE_MASS,
        "magnitude": 1.0,
        "direction": [1.0, 0.0],
        "over": {"quantity": "x", "rate": True},
        "course": {
            "type": "table",
            "knots": knots.tolist(),
            "values": [*friction[::-1].tolist(), *(-friction).tolist()],
            "outside": "held",
        },
    }
    scene = sliding("belt-oscillator", 0.1, spring=spring, friction=rubbing)
    return scene | {"period": 2.0 * math.pi}


def magnets(height: float = 0.2) -> dict[str, Any]:
    """Return r'' = -0.2 r' - 0.64 r + three magnets' pull, at the corners of a triangle.

    A magnet at the distance s in the plane pulls with s / (s^2 + height^2)^(3/2).
    """
    corners = {f"magnet{k}": [math.cos(k * THIRD), math.sin(k * THIRD)] for k in range(3)}
    apart = np.concatenate([np.linspace(0.0, 0.5, 26), np.geomspace(0.52, 12.0, 38)])
    pull = apart / (apart**2 + height**2) ** 1.5
    table = {"type": "table", "between": "smooth", "outside": "held"}
    table |= {"knots": apart.tolist(), "values": pull.tolist()}
    magnet = {"type": "tension", "second": "bob.centre", "magnitude": 1.0, "course": table}
    drag = {"type": "force", "first": "ground.O", "second": "bob.centre", "magnitude": -0.2}
    drag |= {"course": {"type": "polynomial", "coefficients": [0.0, 1.0]}}
    spring = {"type": "spring-damper", "first": "ground.O", "second": "bob.centre"}
    slide = {"type": "prismatic"}
    return {
        "name": "magnetic-pendulum",
        "ground": {"points": {"O": [0.0, 0.0], **corners}},
        "bodies": {
            "carriage": {"mass": 1e-9, "inertia": 1.0, "points": {"C": [0.0, 0.0]}},
            "bob": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}},
        },
        "joints": {
            "x": slide | {"guide": "ground.O", "slider": "carriage.C", "axis": [1.0, 0.0]},
            "y": slide | {"guide": "carriage.C", "slider": "bob.centre", "axis": [0.0, 1.0]},
        },
        "forces": {
            "spring": spring | {"stiffness": 0.64},
            "drag_x": drag | {"direction": [1.0, 0.0], "over": {"quantity": "x", "rate": True}},
            "drag_y": drag | {"direction": [0.0, 1.0], "over": {"quantity": "y", "rate": True}},
            **{
                name: magnet | {"first": f"ground.{name}", "over": {"quantity": "distance"}}
                for name in corners
            },
        },
        "period": 2.0 * math.pi,
    }


def impact_oscillator() -> dict[str, Any]:
    """Return the preset at 28 rad/s, whose stiff stop has exactly the restitution 0.8."""
    study = admit({"kind": "poincare", "scene": {"preset": "impact-oscillator"}, "settle": 0})
    assert isinstance(study, Study)
    found = study.point_scene(0).model_dump(mode="json", exclude_none=True)
    found["joints"]["stop"]["clearance"]["contact"] = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": 1e11, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": 0.8},
    }
    found["drivers"]["motor"]["speed"] = 28.0
    return {name: part for name, part in found.items() if name not in ("parameters", "outputs")}
