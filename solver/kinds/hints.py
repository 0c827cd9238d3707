"""Hints at what a scene asks for and may mean otherwise: a check tells them, no job is refused."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from jointplay.records.failure import Problem
from jointplay.solver.kinds.declared_hints import idle_widths, other_units
from jointplay.solver.laws.force import ForceElement
from jointplay.solver.laws.force.spring_damper import SpringDamper
from jointplay.solver.quantities.frames import WORLD
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import targeted_paths

Pose = Mapping[str, tuple[float, float, float]]
"""Centre of mass, m, and angle, rad, of each body."""
DIGITS = 4


def hints(written: Mapping[str, Any], scene: Scene, pose: Pose) -> list[Problem]:
    """Return them, each with a pointer into the scene.

    Parameters
    ----------
    written
        The document of which the scene was made, without fields that were filled in; of a preset
        nothing is told.
    pose
        At t = 0.
    """
    if "preset" in written:
        return []
    given, setting = written.get("forces", {}), targeted_paths(scene)
    found = []
    for name, element in scene.forces.items():
        pointer = f"/forces/{name}"
        length = f"{pointer}/free_length"
        if "free_length" not in given.get(name, {}) and length not in setting:
            found += [Problem(length, text) for text in _relaxed(name, element, scene, pose)]
        found += [Problem(pointer, text) for text in _idle_moment(name, element, scene)]
    found += [*_deep_journals(scene), *idle_widths(written, scene, setting)]
    return [*found, *other_units(scene)]


def _deep_journals(scene: Scene) -> Iterator[Problem]:
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


def _relaxed(name: str, element: ForceElement, scene: Scene, pose: Pose) -> Iterator[str]:
    """Yield that a spring without a free length pulls as it is drawn."""
    if not isinstance(element, SpringDamper) or not element.stiffness:
        return
    drawn = math.dist(*(_place(point, scene, pose) for point in (element.first, element.second)))
    length = float(f"{drawn:.{DIGITS}g}")
    if length > 0.0:
        yield (
            f"'{name}' has no free_length, and so is relaxed at length 0: at the start it is"
            f" {length:g} m long and pulls with {element.stiffness * drawn:.{DIGITS}g} N. If it"
            f' shall be relaxed as it is drawn, give "free_length": {length:g}.'
        )


def _place(reference: str, scene: Scene, pose: Pose) -> tuple[float, float]:
    """Return where a point is, m."""
    body, point = reference.split(".")
    if body == WORLD:
        u, v = scene.ground.points[point]
        return u, v
    (x, y, angle), (u, v) = pose[body], scene.bodies[body].points[point]
    c, s = math.cos(angle), math.sin(angle)
    return x + c * u - s * v, y + s * u + c * v


def _idle_moment(name: str, element: ForceElement, scene: Scene) -> Iterator[str]:
    """Yield that a moment turns nothing, as joints hold the angle that it acts on."""
    if not element.is_moment:
        return
    first, second = (point.split(".")[0] for point in (element.first, element.second))
    between = _holding(scene, first, second)
    if between:
        joints = " and ".join(f"'{joint}'" for joint in between)
        yield (
            f"'{name}' moves nothing: '{second}' does not turn against '{first}', as {joints}"
            " holds its angle, and bears the moment. To push what slides, give a 'force'."
        )


def _holding(scene: Scene, first: str, second: str) -> list[str]:
    """Return the joints that hold the angle of two bodies against each other; empty: none do."""
    ways: dict[str, list[str]] = {first: []}
    reached = [first]
    for body in reached:
        for name, joint in scene.joints.items():
            if not joint.holds_angle or joint.has_play or body not in joint.bodies:
                continue
            (other,) = {*joint.bodies} - {body}
            if other not in ways:
                ways[other] = [*ways[body], name]
                reached.append(other)
    return ways.get(second, [])
