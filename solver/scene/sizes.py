"""Numbers of a scene that must fit each other: for one scene, or for columns of numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from jointplay.records.failure import Problem
from jointplay.solver.quantities.rule import Rule
from jointplay.solver.scene.document import Joint, Prismatic, Revolute, Scene

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


def out_of_reach(start: Any, joint: Any) -> Any:
    """Whether a journal would start with its centre outside the bearing."""
    return np.hypot(*start.eccentricity) >= joint.clearance.bearing_radius


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


def size_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what does not fit; pointers begin at the scene."""
    yield from _unreachable(scene)
    for name, joint in scene.joints.items():
        for place, rule, part in rules(joint, joint):
            if rule.broken(part):
                yield Problem(f"/joints/{name}{place}/{rule.field}", rule.sentence(part))


def ill_sized(
    scene: Scene, columns: Mapping[str, NDArray[np.float64]], points: int
) -> NDArray[np.bool_]:
    """Return (points,) at which points something does not fit.

    Parameters
    ----------
    scene
        Has the numbers that are the same at every point.
    columns
        (points,) numbers by their JSON pointer in the scene, in place of the scene's.
    """
    broken = np.zeros(points, np.bool_)
    for name, joint in scene.joints.items():
        place, start = f"/joints/{name}", f"/start/joints/{name}"
        if any(path.startswith((f"{place}/", f"{start}/")) for path in columns):
            seen = _seen(joint, place, columns)
            for _, rule, part in rules(joint, seen):
                broken |= rule.broken(part)
            if name in scene.start.joints:
                broken |= out_of_reach(_seen(scene.start.joints[name], start, columns), seen)
    return broken


def rules(joint: Joint, seen: Any) -> Iterator[tuple[str, Rule, Any]]:
    """Yield the place below a joint, the rule and the part that it is about.

    `seen` is the joint, or the joint with columns for numbers.
    """
    if isinstance(joint, Prismatic):
        yield from (("", rule, seen) for rule in GUIDE)
    if not isinstance(joint, Revolute) or joint.clearance is None:
        return
    yield from (("/clearance", rule, seen.clearance) for rule in CLEARANCE)
    for field in ("contact", "friction"):
        law = getattr(joint.clearance, field)
        part = getattr(seen.clearance, field)
        if law is not None:
            yield from ((f"/clearance/{field}", rule, part) for rule in law.rules)


def _seen(node: Any, path: str, columns: Mapping[str, NDArray[np.float64]]) -> Any:
    if path in columns:
        return columns[path]
    if isinstance(node, BaseModel):
        fields = type(node).model_fields
        inner = {name: _seen(getattr(node, name), f"{path}/{name}", columns) for name in fields}
        return type(node).model_construct(**inner)
    if isinstance(node, list):
        return [_seen(item, f"{path}/{index}", columns) for index, item in enumerate(node)]
    return node
