"""The attractors of starts as a document: shares, cycles, exponents, the boundary of a map."""

import math
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.attractors import (
    Attractors,
    attractors_of,
    colour_of_attractor,
    parameter_of,
)
from jointplay.records.basin_boundary import boundary_dimension
from jointplay.records.coarse_to_fine import order_of, over_axes
from jointplay.records.cycles import MEAN, SPREAD
from jointplay.records.motion import WAITING
from jointplay.records.point import has_ended
from jointplay.records.share_error import share_error
from jointplay.records.strict_json import finite
from jointplay.records.study import StudySource


def attractor_table(source: StudySource) -> dict[str, Any]:
    """Return the attractors that are known of many starts.

    Each has its label, name and colour, its points and their share of those that have ended with
    its standard error, and one point that ends on it with what is known of that; over a
    parameter also its shares at each value. A map has the dimension of its boundary.
    """
    found = attractors_of(source)
    over = shares_along(source, found)
    return {
        "complete": source.complete,
        "points": source.points,
        "ended": int(has_ended(source.status).sum()),
        "along": None if over is None else over.document(source),
        "attractors": [
            {
                "code": one.code,
                "name": one.name,
                "colour": colour_of_attractor(one.code),
                "points": one.points,
                "share": one.share,
                "share_error": one.error,
                "shares": None if over is None else finite(over.shares[k].tolist()),
                "share_errors": None if over is None else finite(over.errors[k].tolist()),
                **_example(source, one.example),
            }
            for k, one in enumerate(found.found)
        ],
        "boundary": _boundary(source, found),
    }


class SharesAlong:
    """Shares of attractors over the values of a parameter."""

    def __init__(self, column: int, values: Floats, ended: Integers, counts: Integers) -> None:
        self.column = column
        """Column of the parameter."""
        self.values = values
        """(values,) ascending, in its unit."""
        self.ended = ended
        """(values,) points that have ended."""
        with np.errstate(invalid="ignore", divide="ignore"):
            self.shares: Floats = counts / ended
            """(attractors, values) of these; NaN where none has."""
        self.errors: Floats = share_error(counts, ended)
        """(attractors, values) standard errors."""

    def document(self, source: StudySource) -> dict[str, Any]:
        """Return the parameter, its values, and how many points of each have ended."""
        parameter = source.parameters[self.column]
        return {
            "parameter": parameter.name,
            "unit": parameter.unit,
            "values": self.values.tolist(),
            "ended": self.ended.tolist(),
        }


def shares_along(source: StudySource, found: Attractors) -> SharesAlong | None:
    """Return the shares at each value of the parameter along which they are wanted; None: none."""
    column = parameter_of(source)
    if column is None:
        return None
    values, which = np.unique(source.values[:, column], return_inverse=True)

    def counted(points: Any) -> Integers:
        return np.bincount(which[points], minlength=len(values))

    ended = counted(found.labels != WAITING)
    rows = [counted(found.labels == one.code) for one in found.found]
    counts = np.array(rows, np.int64).reshape(len(rows), len(values))
    return SharesAlong(column, values, ended, counts)


def _boundary(source: StudySource, found: Attractors) -> dict[str, Any] | None:
    if len(source.shape) != 2:
        return None
    order = order_of(source.attributes.get("job", {}), source.shape)
    boundary = boundary_dimension(over_axes(found.labels, order, source.shape))
    if boundary is None:
        return None
    return {
        "dimension": boundary.value,
        "error": boundary.error,
        "distances": list(boundary.distances),
        "shares": list(boundary.shares),
    }


def _example(source: StudySource, point: int) -> dict[str, Any]:
    """Return what is known of one point, and where it lies in a map."""
    row = column = None
    if len(source.shape) == 2:
        index = int(order_of(source.attributes.get("job", {}), source.shape)[point])
        row, column = divmod(index, source.shape[1])
    known = {
        name: float(values[point])
        for name, values in {**source.statistics, **source.indicators}.items()
        if math.isfinite(values[point])
    }
    cycle = {
        field: {name.removeprefix(kind): x for name, x in known.items() if name.startswith(kind)}
        for field, kind in (("mean", MEAN), ("spread", SPREAD))
    }
    numbers = {name: known.get(name) for name in ("period", "lyapunov", "lyapunov_error")}
    return {"point": point, "column": column, "row": row, **numbers, **cycle}
