"""The points of a study as they are written: which parameters, which values, where they stand."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.coarse_to_fine import order_of
from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.scene import start_numbers
from jointplay.solver.scene.document import Parameter, Scene
from jointplay.solver.scene.parameters import allowed_range


@dataclass(frozen=True, eq=False)
class Axis:
    """One parameter, or number of the start, that varies, and its values as they are written."""

    parameter: str
    name_pointer: str
    """JSON pointer to where the job names the parameter."""
    values: Floats
    """(written,)"""
    pointer: Callable[[int], str]
    """JSON pointer to a written value by its index."""
    start: str = ""
    """JSON pointer into the scene to a number of the start, if it is one."""


@dataclass(frozen=True, eq=False)
class Points:
    """Every point of a study."""

    axes: tuple[Axis, ...]
    """None where nothing varies."""
    written: Integers
    """(points, axes) index of each point's value among those written."""
    whole: Callable[[int], str]
    """JSON pointer to what makes a point."""
    grid: tuple[int, ...] = ()
    """Values on each axis, where results are kept over the axes; empty: point by point."""

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.written)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape in which results are kept; of a map the numbers of values along y and x."""
        return self.grid or (self.count,)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the axes."""
        return tuple(axis.parameter for axis in self.axes)

    def values(self) -> Floats:
        """Return (points, axes)."""
        columns = [axis.values[self.written[:, k]] for k, axis in enumerate(self.axes)]
        return np.stack(columns, axis=1) if columns else np.empty((self.count, 0))

    def at(self, point: int) -> dict[str, float]:
        """Return the value of each parameter at a point."""
        return {
            axis.parameter: float(axis.values[self.written[point, k]])
            for k, axis in enumerate(self.axes)
        }

    def pointer(self, point: int, parameter: str | None = None) -> str:
        """Return a JSON pointer to a parameter's value at a point, or to the point."""
        for k, axis in enumerate(self.axes):
            if axis.parameter == parameter or len(self.axes) == 1:
                return axis.pointer(int(self.written[point, k]))
        return self.whole(point)

    def name(self, point: int, scene: Scene) -> str:
        """Return how a sentence begins that is about one point."""
        values = ", ".join(
            f"{name} = {value:.6g}" + _unit(scene.parameters[name])
            for name, value in self.at(point).items()
        )
        return f"{'Value' if len(self.axes) == 1 else 'Point'} {point} ({values}): "


def one_point(count: int = 1) -> Points:
    """Return points at which nothing varies."""
    return Points((), np.zeros((count, 0), np.int64), lambda _point: "/scene")


def one_axis(axis: Axis) -> Points:
    """Return points along one axis."""
    index = np.arange(len(axis.values), dtype=np.int64)
    return Points((axis,), index[:, None], axis.pointer)


def product(axes: Sequence[Axis], pointer: str) -> Points:
    """Return the Cartesian product of axes, the first varying slowest."""
    index = np.indices([len(axis.values) for axis in axes], dtype=np.int64)
    return Points(tuple(axes), index.reshape(len(axes), -1).T, lambda _point: pointer)


def plane(y: Axis, x: Axis, pointer: str, job: Mapping[str, Any]) -> Points:
    """Return the points of a map over two axes, coarse to fine.

    `job` : the map's document; see `order_of`. InvalidInput: both axes are of one parameter.
    """
    if y.parameter == x.parameter:
        sentence = f"Both axes are '{x.parameter}'; let another parameter vary along this one."
        raise InvalidInput.at(y.name_pointer, sentence)
    shape = len(y.values), len(x.values)
    written = np.stack(np.divmod(order_of(job, shape), shape[1]), axis=1)
    return Points((y, x), written, lambda _point: pointer, grid=shape)


def check_map(points: Points) -> None:
    """Refuse (InvalidInput) a value that an axis of a map has twice."""
    check_distinct(points.axes if points.grid else (), "a map has it once")


def check_distinct(axes: Sequence[Axis], why: str) -> None:
    """Refuse (InvalidInput) a value that an axis has twice; `why` : a clause."""
    problems = []
    for axis in axes:
        values, times = np.unique(axis.values, return_counts=True)
        if times.max() > 1:
            value = values[times.argmax()]
            again = int(np.flatnonzero(axis.values == value)[1])
            sentence = f"{value:g} is there twice, and {why}; drop one."
            problems.append(Problem(axis.pointer(again), sentence))
    if problems:
        raise InvalidInput(problems)


def check_parameters(points: Points, scene: Scene) -> None:
    """Refuse (InvalidInput) parameters that are not declared or no numbers, and wild values.

    Each at its name or at its value, which the sentence names with its index.
    """
    problems = []
    for axis in points.axes:
        parameter = scene.parameters.get(axis.parameter)
        if parameter is None:
            sentence = unknown("parameter", axis.parameter, scene.parameters)
            sentence = start_numbers.obstacle(scene, axis.start) if axis.start else sentence
            problems.append(Problem(axis.name_pointer, sentence))
        elif parameter.choices is not None:
            sentence = (
                f"'{axis.parameter}' is one of {', '.join(parameter.choices)}; only a parameter"
                " whose values are numbers can vary. Set it in the scene instead."
            )
            problems.append(Problem(axis.name_pointer, sentence))
        else:
            problems += _outside(axis, parameter)
    if problems:
        raise InvalidInput(problems)


MOST_NAMED = 8
"""Bad values that are named; of any further ones the last sentence gives the number."""


def _outside(axis: Axis, parameter: Parameter) -> list[Problem]:
    values = axis.values
    low = -np.inf if parameter.minimum is None else parameter.minimum
    high = np.inf if parameter.maximum is None else parameter.maximum
    bad = np.flatnonzero(~((low <= values) & (values <= high) & np.isfinite(values)))
    first: dict[str, int] = {}
    for index in (bad[0], bad[-1], *bad[1:MOST_NAMED]) if len(bad) else ():
        first.setdefault(axis.pointer(int(index)), int(index))
    named = sorted(list(first.items())[:MOST_NAMED], key=lambda item: item[1])
    return with_rest(
        [
            Problem(
                pointer,
                f"Value {index} of '{axis.parameter}' is {values[index]:.12g}{_unit(parameter)};"
                f" it {allowed_range(parameter)}.",
            )
            for pointer, index in named
        ],
        len(bad) - len(named),
    )


def with_rest(problems: list[Problem], rest: int) -> list[Problem]:
    """Return problems, the last of which also says how many more there are like them."""
    if problems and rest > 0:
        last = problems[-1]
        others = "another" if rest == 1 else f"{rest} others"
        problems[-1] = Problem(last.pointer, f"{last.detail} So it is with {others}.")
    return problems


def _unit(parameter: Parameter) -> str:
    return "" if parameter.unit == "1" else f" {parameter.unit}"
