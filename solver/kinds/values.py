"""The values that a parameter takes: a list, or a range with a count and a spacing.

A list or a range that a job writes becomes an axis of points.
"""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.points import Axis
from jointplay.solver.quantities.equal_ratios import equal_ratios
from jointplay.solver.quantities.units import Strict, quantity
from jointplay.solver.scene.unions import discriminated_by, form

UNIT = "the parameter's unit"


class Range(Strict):
    """`count` values from the first to the last, both included, in equal steps or equal ratios."""

    start: Annotated[float, quantity(UNIT, alias="from")]
    stop: Annotated[float, quantity(UNIT, alias="to")]
    count: Annotated[int, quantity("1", ge=1, le=10**12, description="number of values")]
    spacing: Annotated[
        Literal["linear", "log"],
        Field(description="linear: equal steps; log: equal ratios, for values of one sign"),
    ] = "linear"


def _form_of_values(value: Any) -> str | None:
    if isinstance(value, list):
        return "list"
    return "range" if isinstance(value, dict | Range) else None


Values = Annotated[
    Annotated[Range, form("range")]
    | Annotated[list[Annotated[float, quantity(UNIT)]], Field(min_length=1), form("list")],
    discriminated_by(
        _form_of_values,
        "The values must be a list of numbers, or an object with 'from', 'to' and 'count'",
    ),
]


def count(values: Range | list[float]) -> int:
    """Return how many values there are, without making them."""
    return values.count if isinstance(values, Range) else len(values)


def numbers(values: Range | list[float]) -> Floats:
    """Return the values, (count,); a range hits both its ends exactly."""
    if not isinstance(values, Range):
        return np.array(values, np.float64)
    spaced = np.linspace if values.spacing == "linear" else equal_ratios
    return spaced(values.start, values.stop, values.count)


def axis(parameter: str, values: Range | list[float], name_pointer: str, pointer: str) -> Axis:
    """Return the axis of a parameter whose values stand at a pointer.

    InvalidInput: a range that does not move, or that logarithmic spacing cannot bridge.
    """
    if not isinstance(values, Range):
        return Axis(parameter, name_pointer, numbers(values), lambda index: f"{pointer}/{index}")
    problem = _range_problem(values, pointer)
    if problem is not None:
        raise InvalidInput([problem])
    last = values.count - 1
    ends = {0: f"{pointer}/from", last: f"{pointer}/to"}
    return Axis(parameter, name_pointer, numbers(values), lambda index: ends.get(index, pointer))


def _range_problem(values: Range, pointer: str) -> Problem | None:
    start, stop = values.start, values.stop
    if values.count == 1 and start != stop:
        sentence = f"One value cannot reach from {start:g} to {stop:g}; ask for 2 at least."
        return Problem(f"{pointer}/count", sentence)
    if values.count > 1 and start == stop:
        return Problem(
            f"{pointer}/to",
            f"From {start:g} to {stop:g} all {values.count} values are the same; give another end,"
            " or a count of 1.",
        )
    if values.spacing == "log" and not (start > 0.0 < stop or start < 0.0 > stop):
        return Problem(
            f"{pointer}/spacing",
            f"Equal ratios do not lead from {start:g} to {stop:g}; with 'log' both ends are above"
            " zero, or both below.",
        )
    return None
