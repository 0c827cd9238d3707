"""Numbers of a scene that must fit each other: for one scene, or for columns of numbers."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import Problem
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.units import Rule
from jointplay.solver.scene.cams import CamJoint, FlatFollower
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.joints import Fixed, Joint, PinInSlot, Prismatic, Revolute

CLEARANCE = (
    Rule(
        "radial_clearance",
        lambda clearance: clearance.radial_clearance >= clearance.bearing_radius,
        lambda clearance: (
            f"A radial clearance of {clearance.radial_clearance:g} m leaves no journal in a"
            f" bearing of radius {clearance.bearing_radius:g} m; it must be smaller."
        ),
    ),
)
GUIDE = (
    Rule(
        "axis",
        lambda joint: (joint.axis[0] == 0.0) & (joint.axis[1] == 0.0),
        lambda _joint: "The axis has no direction; give e.g. [1, 0].",
    ),
)
FACE = (
    Rule(
        "normal",
        lambda joint: (joint.normal[0] == 0.0) & (joint.normal[1] == 0.0),
        lambda _joint: "The normal has no direction; give e.g. [0, 1].",
    ),
)
GEAR = (
    Rule(
        "ratio",
        lambda gear: gear.ratio == 0.0,
        lambda gear: "A ratio of 0 lets the second joint stand still; weld it, or give a ratio.",
    ),
)
WALL = (
    Rule(
        "contact",
        lambda clearance: clearance.contact.needs_radii,
        lambda clearance: (
            f"The law '{clearance.contact.title}' takes its stiffness from the radii of journal and"
            " bearing, which a wall or a cam has not; give a stiffness (N/m^n)."
        ),
    ),
    Rule(
        "friction",
        lambda clearance: (
            clearance.friction is not None and not clearance.friction.slips_with_material
        ),
        lambda _clearance: (
            "The slip velocity 'as-published' is that of a journal in its bearing; at a wall or a"
            " cam take 'material'."
        ),
    ),
)
SLIDER = (
    *WALL,
    Rule(
        "length",
        lambda clearance: (
            np.hypot(clearance.length, clearance.height)
            <= clearance.height + 2.0 * clearance.wall_clearance
        ),
        lambda clearance: (
            f"A slider {clearance.length:g} m long and {clearance.height:g} m high could turn over"
            f" between walls {clearance.height + 2.0 * clearance.wall_clearance:g} m apart; make it"
            " longer."
        ),
    ),
)

PLAY = {
    "revolute": CLEARANCE,
    "prismatic": SLIDER,
    "pin-in-slot": WALL,
    "flat-follower": WALL,
    "roller-follower": WALL,
}
"""Rules of the clearance of each type of joint."""


def out_of_reach(start: Any, joint: Any) -> Any:
    """Tell whether a journal would start with its centre outside the bearing."""
    return np.hypot(*start.eccentricity) >= joint.clearance.bearing_radius


def too_deep(start: Any, joint: Any) -> Any:
    """Tell whether a journal would start deeper than its contact law holds."""
    clearance = joint.clearance
    depth = np.hypot(*start.eccentricity) - clearance.radial_clearance
    return depth > clearance.contact.deepest(clearance)


def _unreachable(scene: Scene) -> Iterator[Problem]:
    for name, start in scene.start.joints.items():
        joint = scene.joints.get(name)
        if isinstance(joint, Revolute) and joint.clearance and out_of_reach(start, joint):
            x, y = start.eccentricity
            yield Problem(
                f"/start/joints/{name}/eccentricity/{int(abs(y) > abs(x))}",
                f"An eccentricity of {math.hypot(x, y):g} m is beyond reach: the journal's centre"
                f" would be outside the bearing, whose radius is"
                f" {joint.clearance.bearing_radius:g} m.",
            )
        elif isinstance(joint, Revolute) and joint.clearance and too_deep(start, joint):
            x, y = start.eccentricity
            deepest = joint.clearance.contact.deepest(joint.clearance)
            yield Problem(
                f"/start/joints/{name}/eccentricity/{int(abs(y) > abs(x))}",
                f"At an eccentricity of {math.hypot(x, y):g} m the journal is deeper in its bearing"
                f" than {deepest:.3g} m, where the logarithm of the law"
                f" '{joint.clearance.contact.title}' ends; start it less deep.",
            )


def size_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what does not fit; pointers begin at the scene."""
    yield from _unreachable(scene)
    for place, rules, part in _parts(scene):
        for rule in rules:
            if rule.broken(part):
                yield Problem(f"{place}/{rule.field}", rule.sentence(part))


def ill_sized(scene: Scene, columns: Mapping[str, Floats], points: int) -> Flags:
    """Return (points,) at which points something does not fit.

    `columns` : (points,) numbers by their JSON pointer in the scene, in place of the scene's, which
    are the same at every point.
    """
    broken = np.zeros(points, np.bool_)
    for place, rules, part in _parts(scene):
        if any(path.startswith(f"{place}/") for path in columns):
            seen = _seen(part, place, columns)
            for rule in rules:
                broken |= rule.broken(seen)
    for name, start in scene.start.joints.items():
        places = f"/start/joints/{name}", f"/joints/{name}"
        if any(path.startswith((f"{places[0]}/", f"{places[1]}/")) for path in columns):
            seen = (
                _seen(start, places[0], columns),
                _seen(scene.joints[name], places[1], columns),
            )
            with np.errstate(all="ignore"):  # of numbers that are refused by themselves
                broken |= out_of_reach(*seen) | too_deep(*seen)
    return broken


def _parts(scene: Scene) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    """Yield the place, the rules and the part of everything in a scene that has rules."""
    for name, joint in scene.joints.items():
        yield from _of_joint(f"/joints/{name}", joint)
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            yield f"/drivers/{name}/motion", driver.motion.rules, driver.motion
    for name, gear in scene.gears.items():
        yield f"/gears/{name}", GEAR, gear
    for name, element in scene.forces.items():
        yield f"/forces/{name}", element.rules, element
        if isinstance(element, Varying) and element.course is not None:
            yield f"/forces/{name}/course", element.course.rules, element.course


def _of_joint(place: str, joint: Joint) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    if isinstance(joint, Prismatic | PinInSlot):
        yield place, GUIDE, joint
    if isinstance(joint, CamJoint):
        yield f"{place}/profile", joint.profile.rules, joint.profile
    if isinstance(joint, FlatFollower):
        yield place, FACE, joint
    play = None if isinstance(joint, Fixed) else joint.clearance
    if play is not None:
        own = play.contact.clearance_rules if isinstance(joint, Revolute) else ()
        yield f"{place}/clearance", (*PLAY[joint.type], *own), play
        yield from _ruled(f"{place}/clearance", play)


def _ruled(place: str, part: BaseModel) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    """Yield the laws in a part, and the laws in those, by their fields."""
    for name in type(part).model_fields:
        law = getattr(part, name)
        if isinstance(law, BaseModel):
            yield f"{place}/{name}", getattr(law, "rules", ()), law
            yield from _ruled(f"{place}/{name}", law)


def _seen(node: Any, path: str, columns: Mapping[str, Floats]) -> Any:
    if path in columns:
        return columns[path]
    if isinstance(node, BaseModel):
        fields = type(node).model_fields
        inner = {name: _seen(getattr(node, name), f"{path}/{name}", columns) for name in fields}
        return type(node).model_construct(**inner)
    if isinstance(node, list):
        return [_seen(item, f"{path}/{index}", columns) for index, item in enumerate(node)]
    return node
