"""Checks of all points of a study at once, at little more than the cost of checking one.

Ranges, bounds and sizes that must fit are checked on columns of numbers; names, assembly and
freedom once for each distinct structure and geometry. A point that fails is then checked alone,
by what checks a single job, so that it is refused in the same words.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Flags, Integers
from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.limits import MOST_GEOMETRIES
from jointplay.solver.kinds.mechanism import Echo, check, declared, with_parameters
from jointplay.solver.kinds.periods import check_period, differently_driven
from jointplay.solver.kinds.points import MOST_NAMED, Points, check_map, check_parameters, with_rest
from jointplay.solver.kinds.studies import PlacedPoints, of_parameters
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.runs.study.fields import (
    distinct,
    geometry_columns,
    inadmissible,
    out_of_turn,
    structure_columns,
)
from jointplay.solver.runs.study.scenes import PointScenes, leaves_of
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import POINTER, set_parameters
from jointplay.solver.scene.references import without_effect
from jointplay.solver.scene.sizes import ill_sized

LASH = "/clearance/lash"
"""Place of numbers of which the largest with each geometry is looked at: it may leave nothing of
its cam."""


def check_points(job: MechanismJob, points: Points) -> PlacedPoints:
    """Return the points of a job once every one can be simulated.

    Raises
    ------
    InvalidInput
        At the value that is wrong, with its index; at the scene where it is wrong at every point.
    LimitExceeded
        The scene's equations are too long to compile.
    """
    document, scene, given = declared(job)
    check_parameters(points, scene)
    check_map(points)
    kept, echo = set_parameters(document, scene, given, points.parameters)
    one = _One(points, document, scene, given)
    base = one.first()
    scenes = PointScenes(base, leaves_of(scene, points.parameters, echo), points.values())
    _check_effect(points, scenes, scene, echo)
    columns = {leaf.path: scenes.column(leaf) for leaf in scenes.leaves}
    suspects = inadmissible(scenes) | ill_sized(base, columns, points.count)
    one.refuse(suspects)
    one.refuse(out_of_turn(scenes))
    placed = PlacedPoints(points, scene, scenes, kept, of_parameters(echo, points))
    _check_mechanisms(job, one, scenes, placed.structure)
    check_period(scene, differently_driven(scenes))
    return placed


@dataclass(frozen=True, eq=False)
class _One:
    """Checks one point alone, as the job of a single point would be."""

    points: Points
    document: Mapping[str, Any]
    declared: Scene
    given: Mapping[str, float | str | None]

    def scene(self, point: int) -> Scene:
        values = {**self.given, **self.points.at(point)}
        return with_parameters(self.document, self.declared, values)[0]

    def first(self) -> Scene:
        """Return the scene of a point that is in order; usually that is the first."""
        failed: dict[int, list[Problem]] = {}
        for point in dict.fromkeys((0, self.points.count - 1, self.points.count // 2)):
            try:
                return self.scene(point)
            except InvalidInput as error:
                failed[point] = list(error.problems)
        alike = len({tuple(problems) for problems in failed.values()}) == 1
        if len(failed) > 1 and alike:
            raise InvalidInput(failed[0])
        raise InvalidInput(self.at_values(failed, len(failed)))

    def refuse(self, suspects: Flags) -> None:
        """Check the suspects one by one; refuse those that fail."""
        failed: dict[int, list[Problem]] = {}
        count = int(suspects.sum())
        for point in np.flatnonzero(suspects):
            try:
                self.scene(int(point))
            except InvalidInput as error:
                failed[int(point)] = list(error.problems)
            if len(failed) == MOST_NAMED:
                break
        if failed:
            raise InvalidInput(self.at_values(failed, count))

    def at_values(self, failed: Mapping[int, list[Problem]], count: int) -> list[Problem]:
        """Return the problems of points at their values, one a pointer, of `count` like them."""
        if not self.points.axes:
            return failed[0]
        found: dict[str, Problem] = {}
        named: set[int] = set()
        for point, problems in failed.items():
            for problem in problems:
                parent, _, name = problem.pointer.rpartition("/")
                varies = parent == POINTER and name in self.points.parameters
                pointer = self.points.pointer(point, name if varies else None)
                if pointer not in found:
                    named.add(point)
                    sentence = self.points.name(point, self.declared) + problem.detail
                    found[pointer] = Problem(pointer, sentence)
        return with_rest(list(found.values()), count - len(named))


def _check_effect(points: Points, scenes: PointScenes, scene: Scene, echo: Echo) -> None:
    """Refuse a parameter without effect: beside another field, or since others override it."""
    reaching = {leaf.column for leaf in scenes.leaves}
    idle = {path: sentence for path, _, sentence in without_effect(scenes.base)}
    problems = [
        Problem(points.axes[leaf.column].name_pointer, idle[leaf.path])
        for leaf in scenes.leaves
        if leaf.path in idle
    ]
    for k, axis in enumerate(points.axes):
        if k in reaching:
            continue
        targets = {target.path for target in scene.parameters[axis.parameter].targets}
        others = [
            f"'{name}'"
            for name, parameter in scene.parameters.items()
            if name != axis.parameter
            and (name in points.parameters or echo.get(name) is not None)
            and targets & {target.path for target in parameter.targets}
        ]
        problems.append(
            Problem(
                axis.name_pointer,
                f"'{axis.parameter}' changes nothing here: {', '.join(others)} override it."
                " Leave those out, or vary one of them.",
            )
        )
    if problems:
        raise InvalidInput(problems)


def _check_mechanisms(
    job: MechanismJob, one: _One, scenes: PointScenes, structure: Integers
) -> None:
    """Check each distinct structure and geometry."""
    count = len(scenes.values)
    shapes = list(geometry_columns(scenes))
    if assemble(scenes.scene(0)).redundant_with_play:  # drivers must agree at every point
        driven = (leaf for leaf in scenes.leaves if leaf.path.startswith("/drivers/"))
        shapes += [scenes.column(leaf) for leaf in driven]
    group = distinct([structure.astype(np.float64), *shapes], count)
    _check_geometries(one.points, int(group.max()) + 1)
    failed: dict[int, list[Problem]] = {}
    found: set[int] = set()
    for point in _representatives(scenes, group):
        try:
            _check_mechanism(job, one.scene(point), new=int(structure[point]) not in found)
            found.add(int(structure[point]))
        except LimitExceeded:
            raise
        except InvalidInput as error:
            failed[point] = list(error.problems)
            if len(failed) == MOST_NAMED:
                break
    if failed:
        alike = len({tuple(problems) for problems in failed.values()}) == 1
        varies = bool(shapes) or any(True for _ in structure_columns(scenes))
        everywhere = not found and alike and (len(failed) > 1 or not varies)
        problems = next(iter(failed.values()))
        raise InvalidInput(problems if everywhere else one.at_values(failed, len(failed)))


def _representatives(scenes: PointScenes, group: Integers) -> list[int]:
    """Return a point of each group: the first, or those with the largest lash of each cam."""
    lashes = [scenes.column(leaf) for leaf in scenes.leaves if leaf.path.endswith(LASH)]
    if not lashes:
        return sorted(np.unique(group, return_index=True)[1].tolist())
    found: set[int] = set()
    for lash in lashes:
        order = np.lexsort((-lash, group))  # the first of several alike
        found |= set(order[np.diff(group[order], prepend=-1) != 0].tolist())
    return sorted(found)


def _check_mechanism(job: MechanismJob, scene: Scene, *, new: bool) -> None:
    _, assembly = check(scene, job.formulation if new else None)
    if assembly.freedom_with_play == 0:
        raise InvalidInput.at(
            "/scene",
            "No joint has clearance and the drivers leave no freedom, so there is no motion"
            " to integrate. Give a joint a positive clearance; a job of kind 'simulate'"
            " runs the ideal mechanism.",
        )
    channels(scene)


def _check_geometries(points: Points, count: int) -> None:
    if count > MOST_GEOMETRIES:
        raise LimitExceeded.at(
            points.axes[0].name_pointer,
            f"The {points.count} points have {count} geometries, each of which is put"
            f" together when the job is checked; the limit is {MOST_GEOMETRIES}. Ask for"
            " fewer values, or divide them among several jobs.",
        )
