"""Rows of the table of a branch, one for each orbit."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row
from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.continuation.multipliers import unstable
from jointplay.solver.continuation.special_curve import errors


def row_of(row: Row, seconds: Sequence[float]) -> Floats:
    """Return the numbers of an orbit, in the order of the columns.

    `seconds` : value of the second parameter, where one varies.
    """
    orbit = row.orbit
    map_ = orbit.curve.sections
    along = int(map_.crossing is not None)  # the motion itself, whose multiplier is 0
    leading = orbit.multipliers[: map_.kernel.states - along]
    bounds = np.zeros(2)
    bounds[: len(row.bounds)] = row.bounds
    if orbit.curve.of:
        bounds += errors(orbit)
    facts = [
        orbit.value,
        row.length,
        float(list(LABELS).index(row.label)),
        bounds[0],
        orbit.linear.passage.duration,
        float(orbit.onsets),
        float(unstable(orbit.multipliers, orbit.curve.of, within=orbit.slack)),
        orbit.residual,
        orbit.bar,
        *orbit.looser.passage.margins,
    ]
    if seconds:
        facts += [*seconds, bounds[1]]
    parts = np.column_stack([leading.real, leading.imag]).reshape(-1)
    return np.concatenate([facts, parts, orbit.section.state])


def document_of(rows: Sequence[Row]) -> dict[str, list[dict[str, object]]]:
    """Return the special orbits of a branch as JSON has them: where they stand, and why."""
    return {
        "special": [
            {"row": index, "label": row.label, "value": row.orbit.value, "bound": row.bound}
            | {"note": row.note or LABELS[row.label]}
            for index, row in enumerate(rows)
            if row.label
        ]
    }
