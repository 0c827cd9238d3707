"""Hints at what a scene asks for and may mean otherwise: a check tells them, no job is refused."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from jointplay.records.failure import Problem
from jointplay.solver.kinds.declared_hints import idle_widths, other_units
from jointplay.solver.kinds.rate_hints import fast_starts
from jointplay.solver.kinds.start_hints import (
    DIGITS,
    Pose,
    behind_cams,
    deep_journals,
    driven_from_zero,
    position_of,
    reversed_drivers,
)
from jointplay.solver.kinds.unit_hints import in_degrees, nearly_turns, too_inert, too_soft
from jointplay.solver.laws.force import ForceElement
from jointplay.solver.laws.force.spring_damper import SpringDamper
from jointplay.solver.laws.force.torsion_spring import TorsionSpring
from jointplay.solver.quantities.frames import WORLD
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import targeted_paths

STRAIGHT = 1e-9
"""Twist of a spring, rad, up to which it is drawn relaxed."""


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
        for field, relaxed in (("free_length", _relaxed), ("free_angle", _untwisted)):
            of_field = f"{pointer}/{field}"
            if field not in given.get(name, {}) and of_field not in setting:
                found += [Problem(of_field, text) for text in relaxed(name, element, scene, pose)]
        found += [Problem(pointer, text) for text in _idle_moment(name, element, scene)]
    found += [*deep_journals(scene), *idle_widths(written, scene, setting)]
    found += [*other_units(scene), *in_degrees(scene), *too_inert(scene), *nearly_turns(scene)]
    found += [*too_soft(scene), *reversed_drivers(scene), *behind_cams(scene, pose)]
    found += fast_starts(scene)
    return [*found, *driven_from_zero(written, scene, setting)]


def _relaxed(name: str, element: ForceElement, scene: Scene, pose: Pose) -> Iterator[str]:
    """Yield that a spring without a free length pulls as it is drawn."""
    if not isinstance(element, SpringDamper) or not element.stiffness:
        return
    drawn = math.dist(
        *(position_of(point, scene, pose) for point in (element.first, element.second))
    )
    length = float(f"{drawn:.{DIGITS}g}")
    if length > 0.0:
        yield (
            f"'{name}' has no free_length, and so is relaxed at length 0: at the start it is"
            f" {length:g} m long and pulls with {element.stiffness * drawn:.{DIGITS}g} N. If it"
            f' shall be relaxed as it is drawn, give "free_length": {length:g}.'
        )


def _untwisted(name: str, element: ForceElement, scene: Scene, pose: Pose) -> Iterator[str]:
    """Yield that a torsion spring without a free angle turns as it is drawn."""
    if not isinstance(element, TorsionSpring) or not element.stiffness:
        return
    bodies = (element.first.split(".")[0], element.second.split(".")[0])
    first, second = (0.0 if body == WORLD else pose[body][2] for body in bodies)
    twist = float(f"{second - first:.{DIGITS}g}")
    if abs(twist) > STRAIGHT:
        yield (
            f"'{name}' has no free_angle, and so is relaxed where '{bodies[1]}' is at the angle of"
            f" '{bodies[0]}': at the start it is twisted by {twist:g} rad and turns '{bodies[1]}'"
            f" with {-element.stiffness * twist:.{DIGITS}g} N m. If it shall be relaxed as it is"
            f' drawn, give "free_angle": {twist:g}.'
        )


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
