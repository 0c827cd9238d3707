"""The same mechanism elsewhere: translated, turned, mirrored, or listed in another order."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from jointplay.solver.scene.document import Scene
from tests.solver.readable_mechanics import Instant

Vector = Sequence[float]


def turn(vector: Vector, angle: float) -> list[float]:
    """Return a vector turned by an angle, rad."""
    c, s = math.cos(angle), math.sin(angle)
    return [c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]]


def flip(vector: Vector) -> list[float]:
    """Return a vector with y reversed."""
    return [vector[0], -vector[1]]


def translated(scene: Scene, by: Vector) -> Scene:
    """Return the scene with its ground moved."""
    document = scene.model_dump()
    for name, (x, y) in scene.ground.points.items():
        document["ground"]["points"][name] = [x + by[0], y + by[1]]
    return Scene.model_validate(document)


def ground_side(joint: Any) -> int:
    """Return 1 if the ground is a joint's first end, -1 if its second, else 0."""
    (_, first), (_, second) = joint.ends
    return int(first.startswith("ground.")) - int(second.startswith("ground."))


def turned(instant: Instant, angle: float) -> Instant:
    """Return the scene with the ground and gravity turned, and its state with it."""
    scene = instant.scene
    document = scene.model_dump()
    document["gravity"] = turn(scene.gravity, angle)
    for name, position in scene.ground.points.items():
        document["ground"]["points"][name] = turn(position, angle)
    driven = dict(instant.driven)
    for name, joint in scene.joints.items():
        side = ground_side(joint)
        changed = document["joints"][name]
        if joint.type != "revolute":
            changed["angle"] += side * angle
        if joint.type == "prismatic" and side > 0:
            changed["axis"] = turn(joint.axis, angle)
        for driver, motion in scene.drivers.items():
            if motion.joint == name and joint.type == "revolute":
                driven[driver] += side * angle
                document["drivers"][driver]["position"] += side * angle
    for driver, motion in scene.drivers.items():
        if motion.body:
            driven[driver] += angle
            document["drivers"][driver]["position"] += angle
    return replace(
        instant,
        scene=Scene.model_validate(document),
        position=_coordinates(instant.position, lambda v: turn(v, angle), lambda a: a + angle),
        speed=_coordinates(instant.speed, lambda v: turn(v, angle), lambda w: w),
        driven=driven,
    )


def mirrored(instant: Instant) -> Instant:
    """Return the scene with y, and so every angle, reversed, and its state with it."""
    scene = instant.scene
    document = scene.model_dump()
    document["gravity"] = flip(scene.gravity)
    for owner in (document["ground"], *document["bodies"].values()):
        owner["points"] = {name: flip(position) for name, position in owner["points"].items()}
    driven = dict(instant.driven)
    for name, joint in scene.joints.items():
        changed = document["joints"][name]
        if joint.type != "revolute":
            changed["angle"] = -joint.angle
        if joint.type == "prismatic":
            changed["axis"] = flip(joint.axis)
    for driver, motion in scene.drivers.items():
        if motion.joint is None or scene.joints[motion.joint].type == "revolute":
            driven[driver] = -driven[driver]
            for field in ("position", "speed"):
                document["drivers"][driver][field] *= -1.0
    start = document["start"]
    for field in ("angles", "angular_velocities"):
        start[field] = {body: -value for body, value in start[field].items()}
    start["velocities"] = {body: flip(value) for body, value in start["velocities"].items()}
    return replace(
        instant,
        scene=Scene.model_validate(document),
        position=_coordinates(instant.position, flip, lambda a: -a),
        speed=_coordinates(instant.speed, flip, lambda w: -w),
        driven=driven,
    )


def reordered(scene: Scene, bodies: Sequence[str], joints: Sequence[str]) -> Scene:
    """Return the scene with bodies and joints listed in another order."""
    document = scene.model_dump()
    document["bodies"] = {name: document["bodies"][name] for name in bodies}
    document["joints"] = {name: document["joints"][name] for name in joints}
    return Scene.model_validate(document)


def _coordinates(
    values: dict[str, float],
    vector: Callable[[Vector], list[float]],
    angle: Callable[[float], float],
) -> dict[str, float]:
    moved = {}
    for name, value in values.items():
        body, _, kind = name.partition(".")
        if kind in ("x", "y"):
            moved[name] = vector((values[f"{body}.x"], values[f"{body}.y"]))[kind == "y"]
        else:
            moved[name] = angle(value) if kind == "theta" else value
    return moved
