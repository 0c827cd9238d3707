"""The attractors of a map of basins as a document: shares, cycles, exponents, the boundary."""

import math
from typing import Any

import numpy as np

from jointplay.records.attractors import MEAN, SPREAD, attractors_of, colour_of_attractor
from jointplay.records.basin_boundary import boundary_dimension
from jointplay.records.coarse_to_fine import order_of, over_axes
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource


def attractor_table(source: StudySource) -> dict[str, Any]:
    """Return the attractors that are known of a map of basins.

    Each has its label, name and colour, its points and their share of those that have ended with
    the binomial standard error, and one point that ends on it with what is known of that.
    """
    found, order = attractors_of(source), order_of(source.attributes.get("job", {}), source.shape)
    boundary = boundary_dimension(over_axes(found.labels, order, source.shape))
    return {
        "complete": source.complete,
        "points": source.points,
        "ended": int(np.isin(source.status, (PointStatus.done, PointStatus.failed)).sum()),
        "attractors": [
            {
                "code": one.code,
                "name": one.name,
                "colour": colour_of_attractor(one.code),
                "points": one.points,
                "share": one.share,
                "share_error": one.error,
                **_example(source, one.example, int(order[one.example])),
            }
            for one in found.found
        ],
        "boundary": boundary
        and {
            "dimension": boundary.value,
            "error": boundary.error,
            "distances": list(boundary.distances),
            "shares": list(boundary.shares),
        },
    }


def _example(source: StudySource, point: int, place: int) -> dict[str, Any]:
    """Return what is known of one point, which lies at a place of the map, row by row."""
    row, column = divmod(place, source.shape[1])
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
    return {"column": column, "row": row, **numbers, **cycle}
