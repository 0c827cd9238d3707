"""Numbers of a scene that must fit each other, as rules that hold for one scene or for columns.

A rule reads numbers by name and answers whether it is broken: for a scene a truth value, for
columns of numbers, one row a point of a study, an array of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from jointplay.records.failure import Problem
from jointplay.solver.scene.document import Joint, Prismatic, Revolute, Scene


@dataclass(frozen=True)
class Rule:
    """What must not be: `broken` of the numbers of a joint, at a place below it."""

    place: str
    broken: Callable[[Any], Any]
    sentence: Callable[[Any], str]


CLEARANCE = (
    Rule(
        "clearance/radial_clearance",
        lambda joint: joint.clearance.radial_clearance >= joint.clearance.bearing_radius,
        lambda joint: (
            f"A radial clearance of {joint.clearance.radial_clearance:g} m leaves no journal in a"
            f" bearing of radius {joint.clearance.bearing_radius:g} m; it must be smaller."
        ),
    ),
    Rule(
        "clearance/contact/exponent",
        lambda joint: (
            (joint.clearance.contact.exponent != 1.5) & (joint.clearance.contact.stiffness is None)
        ),
        lambda _joint: (
            "Eq. 9 gives a stiffness for the exponent 1.5 only; with another exponent give a"
            " stiffness (N/m^n)."
        ),
    ),
)
FRICTION = (
    Rule(
        "clearance/friction/static_velocity",
        lambda joint: (
            joint.clearance.friction.static_velocity > joint.clearance.friction.dynamic_velocity
        ),
        lambda joint: (
            f"The static limit velocity ({joint.clearance.friction.static_velocity:g} m/s) is above"
            f" the dynamic one ({joint.clearance.friction.dynamic_velocity:g} m/s); it may at most"
            " equal it."
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
        for rule in rules(joint):
            if rule.broken(joint):
                yield Problem(f"/joints/{name}/{rule.place}", rule.sentence(joint))


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
            for rule in rules(joint):
                broken |= rule.broken(seen)
            if name in scene.start.joints:
                broken |= out_of_reach(_seen(scene.start.joints[name], start, columns), seen)
    return broken


def rules(joint: Joint) -> tuple[Rule, ...]:
    """Return the rules for a joint."""
    if isinstance(joint, Prismatic):
        return GUIDE
    if not isinstance(joint, Revolute) or joint.clearance is None:
        return ()
    return CLEARANCE + (FRICTION if joint.clearance.friction is not None else ())


def _seen(node: Any, path: str, columns: Mapping[str, NDArray[np.float64]]) -> Any:
    if path in columns:
        return columns[path]
    if isinstance(node, BaseModel):
        fields = type(node).model_fields
        inner = {name: _seen(getattr(node, name), f"{path}/{name}", columns) for name in fields}
        return SimpleNamespace(**inner)
    if isinstance(node, list):
        return [_seen(item, f"{path}/{index}", columns) for index, item in enumerate(node)]
    return node
