"""Values as a job writes them, a list or a range, made into an axis of points."""

from __future__ import annotations

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.admission.points import Axis
from jointplay.solver.jobs.values import Range, numbers


def axis(parameter: str, values: Range | list[float], name_place: str, place: str) -> Axis:
    """Return the axis of a parameter whose values stand at a place.

    Raises
    ------
    InvalidInput
        A range that does not move, or that logarithmic spacing cannot bridge.
    """
    if not isinstance(values, Range):
        return Axis(parameter, name_place, numbers(values), lambda index: f"{place}/{index}")
    problem = _range_problem(values, place)
    if problem is not None:
        raise InvalidInput([problem])
    last = values.count - 1
    ends = {0: f"{place}/from", last: f"{place}/to"}
    return Axis(parameter, name_place, numbers(values), lambda index: ends.get(index, place))


def _range_problem(values: Range, place: str) -> Problem | None:
    start, stop = values.start, values.stop
    if values.count == 1 and start != stop:
        sentence = f"One value cannot reach from {start:g} to {stop:g}; ask for 2 at least."
        return Problem(f"{place}/count", sentence)
    if values.count > 1 and start == stop:
        return Problem(
            f"{place}/to",
            f"From {start:g} to {stop:g} all {values.count} values are the same; give another end,"
            " or a count of 1.",
        )
    if values.spacing == "log" and not (start > 0.0 < stop or start < 0.0 > stop):
        return Problem(
            f"{place}/spacing",
            f"Equal ratios do not lead from {start:g} to {stop:g}; with 'log' both ends are above"
            " zero, or both below.",
        )
    return None
