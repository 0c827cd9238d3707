"""Numbers that vary from point to point: whether their fields admit them, what they decide.

Validating the whole scene of each point would take half a millisecond a point, five seconds of a
study of ten thousand: only the field that a number goes to is validated, once for each value.
"""

import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from jointplay.records.arrays import Flags, Floats, Integers
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.whole_turn import repeats_every_turn
from jointplay.solver.mechanics.assembly import link_lengths, opens_play
from jointplay.solver.quantities.units import Strict
from jointplay.solver.quantities.varied import REFUSALS
from jointplay.solver.runs.study.scenes import OF_STARTS, Leaf, PointScenes, replaced
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import value_at
from jointplay.solver.scene.varying_forces import is_over_turns

_CONFIG = ConfigDict(
    strict=Strict.model_config["strict"],
    allow_inf_nan=Strict.model_config["allow_inf_nan"],
)
HARMLESS = re.compile(
    r"/(bodies/[^/]+/(mass|inertia)|gravity/\d|drivers/[^/]+/speed"
    r"|joints/[^/]+/clearance/([^/]+|(contact|friction)/.+)"
    r"|forces/[^/]+/(stiffness|damping|free_angle|magnitude|moment|full_rate"
    r"|stall_torque|no_load_speed|course/(amplitude|frequency|phase|offset|value))"
    r")"
)
"""Numbers that neither the assembly at t = 0 nor any check of names depends on, but for what
`structure_columns` and `out_of_turn` have of them, and clearances where the start opens play.
Everything else counts as geometry."""
OF_MOTION = re.compile(r"/drivers/([^/]+)/motion/.+")
"""Numbers of prescribed motions, of which an assembly depends on the position at t = 0."""
OF_CLEARANCE = re.compile(r"/joints/([^/]+)/clearance/([^/]+)")


def inadmissible(scenes: PointScenes) -> Flags:
    """Return (points,) at which a number is not one that its field takes.

    Each value is put into the field that it goes to, which is validated as in a whole document.
    """
    bad = np.zeros(len(scenes.values), np.bool_)
    for leaf in scenes.leaves:
        model, field, inside = _model_of(scenes.base, leaf.path)
        values, which = np.unique(scenes.column(leaf), return_inverse=True)
        own = getattr(model, field)
        fields: Any = list[type(model).model_fields[field].rebuild_annotation()]  # type: ignore[misc]
        adapter: TypeAdapter[Any] = TypeAdapter(fields, config=_CONFIG)
        try:
            adapter.validate_python([replaced(own, inside, value) for value in values.tolist()])
        except ValidationError as error:
            wrong = {int(item["loc"][0]) for item in error.errors(include_input=False)}
            bad |= np.isin(which, list(wrong))
    return bad


def out_of_turn(scenes: PointScenes) -> Flags:
    """Return (points,) at which a course over a driver's angle does not repeat every turn."""
    bad = np.zeros(len(scenes.values), np.bool_)
    for name, element in scenes.base.forces.items():
        pointer = f"/forces/{name}/course/"
        leaves = [leaf for leaf in scenes.leaves if leaf.path.startswith(pointer)]
        if not leaves or not (isinstance(element, Varying) and is_over_turns(scenes.base, element)):
            continue
        columns = np.stack([scenes.column(leaf) for leaf in leaves], axis=1)
        numbers, which = np.unique(columns, axis=0, return_inverse=True)
        keys = [leaf.path.removeprefix(pointer).split("/") for leaf in leaves]
        repeats = np.empty(len(numbers), np.bool_)
        for index, row in enumerate(numbers.tolist()):
            course: Any = element.course
            for key, value in zip(keys, row, strict=True):
                course = replaced(course, key, value)
            repeats[index] = repeats_every_turn(course)
        bad |= ~repeats[which.reshape(-1)]
    return bad


def structure_columns(scenes: PointScenes) -> Iterator[Integers]:
    """Yield (points,) numbers that tell which points have equations of the same form."""
    for leaf in scenes.leaves:
        column = scenes.column(leaf)
        decided = _structural(scenes.base, leaf.path)
        if decided:
            form = np.zeros(len(column), np.int64)
            for index, value in enumerate(decided):
                form[column == value] = index + 1
            yield form
        if is_clearance(scenes.base, leaf.path):
            yield (column > 0.0).astype(np.int64)


def geometry_columns(scenes: PointScenes) -> Iterator[Floats]:
    """Yield (points,) numbers on which the assembly depends.

    Of a number of the start, or of play that it opens, only its ends count: points between them are
    put together when they are run, and one that does not start as it says fails by itself.
    """
    without_lengths, opened = not link_lengths(scenes.base), opens_play(scenes.base)
    for leaf in scenes.leaves:
        # what touches gives the scale of a mechanism none of whose bodies has two joints apart
        scale = without_lengths and OF_CLEARANCE.fullmatch(leaf.path) is not None
        scale = scale and not is_clearance(scenes.base, leaf.path)
        if OF_STARTS.fullmatch(leaf.path) or (opened and OF_CLEARANCE.fullmatch(leaf.path)):
            column = scenes.column(leaf)
            yield (column == column.max()).astype(np.float64) - (column == column.min())
        elif moved := OF_MOTION.fullmatch(leaf.path):
            yield _first_positions(scenes, moved[1], leaf)
        elif scale or not HARMLESS.fullmatch(leaf.path):
            yield scenes.column(leaf)


def _first_positions(scenes: PointScenes, driver: str, leaf: Leaf) -> Floats:
    """Return (points,) rad or m: where a driver begins; the leaf's numbers if only each can say."""
    try:
        begins = scenes.together().drivers[driver].at(0.0).value
    except REFUSALS:
        return scenes.column(leaf)
    return np.broadcast_to(np.asarray(begins, np.float64), len(scenes.values))


def distinct(columns: Sequence[NDArray[Any]], count: int) -> Integers:
    """Return (points,) the number of each point's combination, by first appearance."""
    if not columns:
        return np.zeros(count, np.int64)
    _, first, which = np.unique(
        np.stack(columns, axis=1), axis=0, return_index=True, return_inverse=True
    )
    order = np.empty(len(first), np.int64)
    order[np.argsort(first)] = np.arange(len(first))
    return np.asarray(order[which.reshape(-1)], np.int64)


def is_clearance(scene: Scene, path: str) -> bool:
    """Return whether the number at a pointer is a joint's play, whatever its type calls it."""
    found = OF_CLEARANCE.fullmatch(path)
    if found is None or found[1] not in scene.joints:
        return False
    slack = scene.joints[found[1]].slack
    return slack is not None and found[2] == slack.play_field


def _structural(scene: Scene, path: str) -> tuple[float, ...]:
    """Return values of a number that decide the form of the equations."""
    model, field, inside = _model_of(scene, path)
    extra = None if inside else type(model).model_fields[field].json_schema_extra
    found = extra.get("structural", ()) if isinstance(extra, dict) else ()
    return tuple(float(value) for value in found)  # type: ignore[union-attr,arg-type]


def _model_of(scene: Scene, path: str) -> tuple[BaseModel, str, list[str]]:
    """Return the innermost part that a number stands in, its field, and the keys inside that."""
    keys = path.strip("/").split("/")
    for depth in range(len(keys) - 1, 0, -1):
        node = value_at(scene, "/".join(keys[:depth]))
        if isinstance(node, BaseModel):
            return node, keys[depth], keys[depth + 1 :]
    return scene, keys[0], keys[1:]
