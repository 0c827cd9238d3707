"""The scenes of a study's points: one checked scene, copied with a few numbers changed.

A copy shares everything that does not change with the scene it came from, so that a point costs
tens of microseconds; it equals what reading the whole document with the point's values would give.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from pydantic import BaseModel

from jointplay.records.arrays import Floats, Integers
from jointplay.solver.quantities.varied import together
from jointplay.solver.runs.study.ended_turns import ended_turn
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import value_at

Branches = dict[str, Any]

OF_STARTS = re.compile(r"/start/.*|/drivers/[^/]+/position")
"""Numbers on which nothing depends but the start."""


@dataclass(frozen=True)
class Leaf:
    """A number of the scene that changes from point to point."""

    path: str
    """JSON pointer into the scene."""
    column: int
    """Index into the points' values."""
    factor: float


@dataclass(frozen=True, eq=False)
class PointScenes:
    """Maker of the scene of any point."""

    base: Scene
    """Checked in full; every leaf is present in it."""
    leaves: tuple[Leaf, ...]
    """Pointers in the document that change from point to point; none twice."""
    values: Floats
    """(points, parameters) in the unit of each."""

    @property
    def starts_vary(self) -> bool:
        """Whether points differ in numbers of their starts."""
        return any(OF_STARTS.fullmatch(leaf.path) for leaf in self.leaves)

    @property
    def beyond_start(self) -> list[int]:
        """Columns of the values on which more depends than the start."""
        return sorted({leaf.column for leaf in self.leaves if not OF_STARTS.fullmatch(leaf.path)})

    def column(self, leaf: Leaf) -> Floats:
        """Return what stands at a leaf, (points,)."""
        if leaf.path not in self._columns:
            given = np.asarray(self.values[:, leaf.column] * leaf.factor, np.float64)
            self._columns[leaf.path] = ended_turn(self.base, leaf.path, given, self.numbers)
        return self._columns[leaf.path]

    @cached_property
    def _columns(self) -> dict[str, Floats]:
        """Values at leaves, (points,), by their paths, of those that were asked for."""
        return {}

    def numbers(self, path: str) -> Floats:
        """Return the number that stands at a path, varied or not, (points,)."""
        for leaf in self.leaves:
            if leaf.path == path:
                return self.column(leaf)
        return np.full(len(self.values), float(value_at(self.base, path)))

    def at_rows(self, rows: Integers) -> PointScenes:
        """Return the scenes of other points: rows of the values, in that order."""
        return PointScenes(self.base, self.leaves, self.values[rows])

    def scene(self, point: int) -> Scene:
        """Return the scene of a point, of which no number was checked."""
        return self._with([float(self.column(leaf)[point]) for leaf in self.leaves])

    def together(self) -> Scene:
        """Return one scene with the numbers of all points, of one structure; see `Varied`."""
        return self._with([together(self.column(leaf).tolist()) for leaf in self.leaves])

    def _with(self, numbers: Sequence[Any]) -> Scene:
        """Return the scene with these numbers at the leaves."""
        if not self.leaves:
            return self.base
        branches: Branches = {}
        for leaf, number in zip(self.leaves, numbers, strict=True):
            *parents, last = leaf.path.strip("/").split("/")
            at = branches
            for key in parents:
                at = at.setdefault(key, {})
            at[last] = number
        changed: Scene = _changed(self.base, branches)
        return changed


def leaves_of(
    scene: Scene, parameters: Sequence[str], echo: Mapping[str, float | str | None]
) -> tuple[Leaf, ...]:
    """Return the pointers that varied parameters reach, a later declaration overriding an earlier.

    `echo` has the values of the parameters that do not vary; one that is none overrides nothing.
    """
    found: dict[str, Leaf] = {}
    for name, parameter in scene.parameters.items():
        for target in parameter.targets:
            if name in parameters:
                found[target.path] = Leaf(target.path, parameters.index(name), target.factor)
            elif echo.get(name) is not None:
                found.pop(target.path, None)
    return tuple(found.values())


def replaced(node: Any, keys: Sequence[str], value: float) -> Any:
    """Return a copy of a part with the number at these keys replaced."""
    for key in reversed(keys):
        value = {key: value}  # type: ignore[assignment]
    return _changed(node, value)


def _changed(node: Any, change: Any) -> Any:
    if not isinstance(change, dict):
        return change
    if isinstance(node, BaseModel):
        return node.model_copy(
            update={key: _changed(getattr(node, key), inner) for key, inner in change.items()}
        )
    if isinstance(node, Mapping):
        return {**node, **{key: _changed(node.get(key), inner) for key, inner in change.items()}}
    copied = list(node)
    for key, inner in change.items():
        copied[int(key)] = _changed(copied[int(key)], inner)
    return copied
