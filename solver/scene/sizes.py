"""Numbers of a scene that must fit each other: for one scene, or for columns of numbers."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import Problem
from jointplay.solver.joints import Joint
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.units import Rule
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver


def _unreachable(scene: Scene) -> Iterator[Problem]:
    for name, start in scene.start.joints.items():
        joint = scene.joints.get(name)
        for field, sentence in joint.start_problems(start) if joint is not None else ():
            yield Problem(f"/start/joints/{name}/{field}", sentence)
    for name, guided in scene.start.guides.items():
        joint = scene.joints.get(name)
        if joint is not None and joint.starts_in_wall(guided):
            field = "offset" if guided.offset else "tilt"
            sentence = (
                f"At this start half of what joint '{name}' guides, or more, would be in a wall or"
                f" a cam; its play is {joint.slack.play if joint.slack else 0.0:g} m: give a"
                " smaller one."
            )
            yield Problem(f"/start/guides/{name}/{field}", sentence)


def size_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what does not fit; pointers begin at the scene."""
    yield from _unreachable(scene)
    for pointer, rules, part in _parts(scene):
        for rule in rules:
            if rule.broken(part):
                yield Problem(f"{pointer}/{rule.field}", rule.sentence(part))


def ill_sized(scene: Scene, columns: Mapping[str, Floats], points: int) -> Flags:
    """Return (points,) at which points something does not fit.

    `columns` : (points,) numbers by their JSON pointer in the scene, in place of the scene's, which
    are the same at every point.
    """
    broken = np.zeros(points, np.bool_)
    for pointer, rules, part in _parts(scene):
        if any(path.startswith(f"{pointer}/") for path in columns):
            seen = _seen(part, pointer, columns)
            for rule in rules:
                broken |= rule.broken(seen)
    for name, start in scene.start.joints.items():
        pointers = f"/start/joints/{name}", f"/joints/{name}"
        if any(path.startswith((f"{pointers[0]}/", f"{pointers[1]}/")) for path in columns):
            joint = _seen(scene.joints[name], pointers[1], columns)
            with np.errstate(all="ignore"):  # of numbers that are refused by themselves
                broken |= joint.cannot_start(_seen(start, pointers[0], columns))
    for name, guided in scene.start.guides.items():
        pointers = f"/start/guides/{name}", f"/joints/{name}"
        if any(path.startswith((f"{pointers[0]}/", f"{pointers[1]}/")) for path in columns):
            joint = _seen(scene.joints[name], pointers[1], columns)
            broken |= joint.starts_in_wall(_seen(guided, pointers[0], columns))
    return broken


def _parts(scene: Scene) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    """Yield the pointer, the rules and the part of everything in a scene that has rules."""
    for name, joint in scene.joints.items():
        yield from _of_joint(f"/joints/{name}", joint)
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            yield f"/drivers/{name}/motion", driver.motion.rules, driver.motion
    for name, gear in scene.gears.items():
        yield f"/gears/{name}", gear.rules, gear
    for name, element in scene.forces.items():
        yield f"/forces/{name}", element.rules, element
        if isinstance(element, Varying) and element.course is not None:
            yield f"/forces/{name}/course", element.course.rules, element.course


def _of_joint(pointer: str, joint: Joint) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    for field, function in joint.functions():
        yield f"{pointer}/{field}", function.rules, function
    yield pointer, joint.rules, joint
    if joint.slack is not None:
        yield f"{pointer}/clearance", joint.slack.rules, joint.slack
        yield from _ruled(f"{pointer}/clearance", joint.slack)


def _ruled(pointer: str, part: BaseModel) -> Iterator[tuple[str, tuple[Rule, ...], Any]]:
    """Yield the laws in a part, and the laws in those, by their fields."""
    for name in type(part).model_fields:
        law = getattr(part, name)
        if isinstance(law, BaseModel):
            yield f"{pointer}/{name}", getattr(law, "rules", ()), law
            yield from _ruled(f"{pointer}/{name}", law)


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
