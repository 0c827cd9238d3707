"""Mechanisms whose start says something: a toggle press, a crank, a lever, balls, a cradle."""

from typing import Any

from jointplay.solver.mechanics.assembly import Assembly, assemble
from jointplay.solver.scene.document import Scene
from tests.solver.mechanics.start.toggle import TOGGLE

ELASTIC = {
    "law": "stiffness-and-dissipation",
    "stiffness": {"law": "power", "stiffness": 1e7, "exponent": 1.5},
    "dissipation": {"law": "exact", "restitution": 0.5},
}


def revolute(bearing: str, journal: str) -> dict[str, Any]:
    return {"type": "revolute", "bearing": bearing, "journal": journal}


def bar(half: float) -> dict[str, Any]:
    return {"mass": 1.0, "inertia": 0.1, "points": {"a": [-half, 0], "b": [half, 0]}}


def slider_crank(start: dict[str, Any], crank: float = 0.25, rod: float = 0.25) -> dict[str, Any]:
    """Return a crank and a rod, given by half their lengths, and a slider; nothing drives them."""
    return {
        "name": "slider-crank",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {
            "crank": bar(crank),
            "rod": bar(rod),
            "slider": {"mass": 3.0, "inertia": 0.1, "points": {"c": [0, 0]}},
        },
        "joints": {
            "O": revolute("ground.O", "crank.a"),
            "A": revolute("crank.b", "rod.a"),
            "B": revolute("slider.c", "rod.b"),
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "slider.c",
                "axis": [1, 0],
            },
        },
        "start": start,
    }


STOPS: dict[str, dict[str, Any]] = {
    "slot": {
        "type": "pin-in-slot",
        "slot": "ground.S",
        "pin": "lever.b",
        "axis": [1, 0],
        "clearance": {"wall_clearance": 0.2, "pin_radius": 0.01, "contact": ELASTIC},
    },
    "pin": revolute("ground.S", "lever.b")
    | {"clearance": {"radial_clearance": 0.2, "bearing_radius": 0.21, "contact": ELASTIC}},
    "follower": {
        "type": "flat-follower",
        "cam": "lever.b",
        "follower": "ground.S",
        "normal": [0, -1],
        "profile": {"type": "constant", "value": 0.2},
        "clearance": {"lash": 0.19, "contact": ELASTIC},
    },
}


def lever(stop: str, start: dict[str, Any]) -> dict[str, Any]:
    """Return a lever of 1 m on an ideal pin, its end in the middle of a stop's wide play."""
    height = -0.2 if stop == "follower" else 0.0
    return {
        "name": "lever",
        "ground": {"points": {"O": [0, 0], "S": [1.0, height]}},
        "bodies": {"lever": bar(0.5)},
        "joints": {"O": revolute("ground.O", "lever.a"), "stop": STOPS[stop]},
        "start": start,
    }


def ball(start: dict[str, Any], lash: float = 1e-3) -> dict[str, Any]:
    """Return a ball of 0.1 m on a floor."""
    return {
        "name": "ball",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {"ball": {"mass": 1.0, "inertia": 0.1, "points": {"c": [0, 0]}}},
        "joints": {
            "floor": {
                "type": "flat-follower",
                "cam": "ball.c",
                "follower": "ground.O",
                "normal": [0, -1],
                "profile": {"type": "constant", "value": 0.1 + lash},
                "clearance": {"lash": lash, "contact": ELASTIC},
            }
        },
        "start": start,
    }


def cradle(start: dict[str, Any], balls: int = 3) -> dict[str, Any]:
    """Return balls of 0.1 m, each on a thread of 1 m, side by side."""
    radius, lash = 0.1, 1e-5
    disc = {"type": "roller-follower", "roller_radius": radius}
    disc |= {"profile": {"type": "constant", "value": 2.0 * radius + lash}}
    disc |= {"clearance": {"lash": lash, "contact": ELASTIC}}
    hung = {"mass": 1.0, "inertia": 0.004, "points": {"top": [0, 1.0], "c": [0, 0]}}
    return {
        "name": "cradle",
        "gravity": [0, -9.81],
        "ground": {"points": {f"O{i}": [2.0 * radius * i, 1.0] for i in range(balls)}},
        "bodies": {f"b{i}": hung for i in range(balls)},
        "joints": {f"p{i}": revolute(f"ground.O{i}", f"b{i}.top") for i in range(balls)}
        | {f"k{i}": disc | {"cam": f"b{i}.c", "follower": f"b{i + 1}.c"} for i in range(balls - 1)},
        "start": start,
    }


def toggle(points: dict[str, list[float]]) -> dict[str, Any]:
    """Return a driven toggle press of which some points are drawn."""
    return TOGGLE | {"start": {"points": points}}


def put_together(document: dict[str, Any]) -> tuple[Assembly, dict[str, Any], dict[str, Any]]:
    """Return the assembly, and by body its pose and its rates, (3,) m, m, rad."""
    scene = Scene.model_validate(document)
    found = assemble(scene)
    pose = dict(zip(scene.bodies, found.pose.reshape(-1, 3), strict=True))
    return found, pose, dict(zip(scene.bodies, found.velocity.reshape(-1, 3), strict=True))
