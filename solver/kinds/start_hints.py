"""Hints at where a mechanism starts and which way it moves, where it may be meant otherwise."""

import math
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from jointplay.records.failure import Problem
from jointplay.solver.quantities.frames import WORLD
from jointplay.solver.scene.document import Scene

Pose = Mapping[str, tuple[float, float, float]]
"""Centre of mass, m, and angle, rad, of each body."""
DIGITS = 4
NEAR = 1e-9
"""Difference of angles, rad, and share of a length, up to which they are one."""


def deep_journals(scene: Scene) -> Iterator[Problem]:
    """Yield the journals that start deeper in their bearings than they have room."""
    for name, start in scene.start.joints.items():
        slack = scene.joints[name].slack
        depth = math.hypot(*start.eccentricity) - (slack.play if slack else 0.0)
        if slack and depth > slack.play:
            yield Problem(
                f"/start/joints/{name}/eccentricity",
                f"The journal of '{name}' starts {depth:.{DIGITS}g} m deep in its bearing, whose"
                f" radial clearance is {slack.play:g} m: contact throws it out.",
            )


def reversed_drivers(scene: Scene) -> Iterator[Problem]:
    """Yield the drivers whose position is that of the ground against a body: it moves backwards."""
    for name, driver in scene.drivers.items():
        joint = scene.joints.get(driver.joint or "")
        if joint is None or joint.bodies[1] != WORLD:
            continue
        first, second = joint.end_fields
        moves = "turns clockwise" if joint.freedom == "turn" else "moves against the axis"
        yield Problem(
            f"/drivers/{name}/joint",
            f"The {second} of '{driver.joint}' is on the ground, so '{joint.bodies[0]}' {moves} as"
            f" the position of '{name}' grows. If it shall not, exchange {first} and {second}.",
        )


def driven_from_zero(
    written: Mapping[str, Any], scene: Scene, setting: Collection[str]
) -> Iterator[Problem]:
    """Yield the drivers without a position that start bodies at other angles than are given.

    written : the document without fields that were filled in. setting : pointers to what parameters
    may change.
    """
    for name, driver in scene.drivers.items():
        pointer = f"/drivers/{name}/position"
        joint = scene.joints.get(driver.joint or "")
        if "position" in written.get("drivers", {}).get(name, {}) or pointer in setting:
            continue
        if driver.body is None and (joint is None or joint.freedom != "turn"):
            continue
        bodies = (WORLD, driver.body) if joint is None else joint.bodies
        angles = {WORLD: 0.0, **scene.start.angles}
        if not angles.keys() >= {*bodies}:
            continue
        given = angles[str(bodies[1])] - angles[bodies[0]]
        driven = float(driver.at(driver.clock_start).value)
        if abs(given - driven) > NEAR:
            yield Problem(
                pointer,
                f"'{name}' has no position, and so starts at {driven:g} rad, where 'start.angles'"
                f' says {given:g}. If it shall start there, give "position": {given - driven:.9g}.',
            )


def behind_cams(scene: Scene, pose: Pose) -> Iterator[Problem]:
    """Yield the faces on cams that start on the other side of them than the points of their guides.

    A face is where its normal says, whatever side that is.
    """
    for name, joint in scene.joints.items():
        if joint.facing is None:
            continue
        body = joint.bodies[1]
        guides = [
            one.points[0]
            for one in scene.joints.values()
            if one.holds_angle and one.freedom == "slide" and one.bodies[1] == body
        ]
        (u, v), angle = joint.facing, 0.0 if body == WORLD else pose[body][2]
        c, s = math.cos(angle), math.sin(angle)
        x, y = position_of(joint.points[0], scene, pose)
        for guide in guides:
            gx, gy = (
                to - of for to, of in zip(position_of(guide, scene, pose), (x, y), strict=True)
            )
            along = gx * (c * u - s * v) + gy * (s * u + c * v)
            if along < -NEAR * math.hypot(gx, gy) * math.hypot(u, v):
                yield Problem(
                    f"/joints/{name}/normal",
                    f"'{body}' starts on the other side of the cam than the point of its guide:"
                    " 'normal' is the direction of the face away from the cam. If it shall start"
                    f" there, give [{0.0 - u:g}, {0.0 - v:g}].",
                )


def position_of(reference: str, scene: Scene, pose: Pose) -> tuple[float, float]:
    """Return where a point is, m."""
    body, point = reference.split(".")
    if body == WORLD:
        u, v = scene.ground.points[point]
        return u, v
    (x, y, angle), (u, v) = pose[body], scene.bodies[body].points[point]
    c, s = math.cos(angle), math.sin(angle)
    return x + c * u - s * v, y + s * u + c * v
