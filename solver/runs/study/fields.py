"""What a scene's fields say of the numbers in them: whether they are admissible, what they decide.

All points of a study are looked at together: a column of numbers against the one field that they
go to, with the same validation as that of the whole document.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from jointplay.solver.mechanics.assembly import link_lengths
from jointplay.solver.quantities.units import Strict
from jointplay.solver.runs.study.scenes import PointScenes, value_at
from jointplay.solver.scene.document import Revolute, Scene

Floats = NDArray[np.float64]

_CONFIG = ConfigDict(
    strict=Strict.model_config["strict"],
    allow_inf_nan=Strict.model_config["allow_inf_nan"],
)
HARMLESS = re.compile(
    r"/(bodies/[^/]+/(mass|inertia)|gravity/\d|drivers/[^/]+/speed"
    r"|joints/[^/]+/clearance/(radial_clearance|bearing_radius|(contact|friction)/[^/]+)"
    r"|start/(velocities/[^/]+/\d|angular_velocities/[^/]+))"
)
"""Numbers that neither the assembly at t = 0 nor any check of names depends on, but for what
`structure_columns` has of them. Everything else counts as geometry."""


def inadmissible(scenes: PointScenes) -> NDArray[np.bool_]:
    """Return (points,) at which a number is not one that its field takes."""
    bad = np.zeros(len(scenes.values), np.bool_)
    for leaf in scenes.leaves:
        numbers: Any = list[_type_at(scenes.base, leaf.path)]  # type: ignore[misc]
        adapter: TypeAdapter[Any] = TypeAdapter(numbers, config=_CONFIG)
        try:
            adapter.validate_python(scenes.column(leaf).tolist())
        except ValidationError as error:
            bad[[int(item["loc"][0]) for item in error.errors(include_input=False)]] = True
    return bad


def structure_columns(scenes: PointScenes) -> Iterator[NDArray[np.int64]]:
    """Yield (points,) numbers that tell which points have equations of the same form."""
    for leaf in scenes.leaves:
        column = scenes.column(leaf)
        decided = _structural(scenes.base, leaf.path)
        if decided:
            form = np.zeros(len(column), np.int64)
            for index, value in enumerate(decided):
                form[column == value] = index + 1
            yield form
        if _is_clearance(scenes.base, leaf.path):
            yield (column > 0.0).astype(np.int64)


def geometry_columns(scenes: PointScenes) -> Iterator[Floats]:
    """Yield (points,) numbers on which the assembly depends."""
    without_lengths = not link_lengths(scenes.base)
    for leaf in scenes.leaves:
        # bearings give the scale of a mechanism none of whose bodies has two joints apart
        scale = without_lengths and leaf.path.endswith("/bearing_radius")
        if scale or not HARMLESS.fullmatch(leaf.path):
            yield scenes.column(leaf)


def distinct(columns: Sequence[NDArray[Any]], count: int) -> NDArray[np.int64]:
    """Return (points,) the number of each point's combination, by first appearance."""
    if not columns:
        return np.zeros(count, np.int64)
    _, first, which = np.unique(
        np.stack(columns, axis=1), axis=0, return_index=True, return_inverse=True
    )
    order = np.empty(len(first), np.int64)
    order[np.argsort(first)] = np.arange(len(first))
    return np.asarray(order[which.reshape(-1)], np.int64)


def _is_clearance(scene: Scene, path: str) -> bool:
    found = re.fullmatch(r"/joints/([^/]+)/clearance/radial_clearance", path)
    return found is not None and isinstance(scene.joints.get(found[1]), Revolute)


def _structural(scene: Scene, path: str) -> tuple[float, ...]:
    field = _field_at(scene, path)
    extra = None if field is None else field.json_schema_extra
    found = extra.get("structural", ()) if isinstance(extra, dict) else ()
    return tuple(float(value) for value in found)  # type: ignore[union-attr,arg-type]


def _field_at(scene: Scene, path: str) -> FieldInfo | None:
    """Return the field that a number stands in directly, not as an item of a list or an object."""
    parent, _, last = path.rpartition("/")
    owner = value_at(scene, parent) if parent else scene
    return type(owner).model_fields.get(last) if isinstance(owner, BaseModel) else None


def _type_at(scene: Scene, path: str) -> Any:
    """Return the annotated type of what stands at a path."""
    node: Any = scene
    annotation: Any = Scene
    for key in path.strip("/").split("/"):
        if isinstance(node, BaseModel):
            field = type(node).model_fields[key]
            annotation = (
                Annotated[field.annotation, *field.metadata]
                if field.metadata
                else (field.annotation)
            )
            node = getattr(node, key)
        else:
            annotation = _item_type(annotation)
            node = node[key] if isinstance(node, Mapping) else node[int(key)]
    return annotation


def _item_type(annotation: Any) -> Any:
    """Return the type of an item of a list or object whose type may be annotated."""
    arguments = get_args(annotation)
    if hasattr(annotation, "__metadata__"):
        return _item_type(arguments[0])
    return arguments[-1]
