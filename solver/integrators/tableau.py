"""A Runge-Kutta method is data: its Butcher tableau, embedded error weights, dense output."""

from collections.abc import Sequence
from dataclasses import dataclass

from jointplay.solver.integrators.method import Method


@dataclass(frozen=True, kw_only=True)
class Tableau(Method):
    """An explicit method whose last stage is the first of the next step (FSAL).

    The last row of `matrix` is the solution's weights b; the FSAL stage counts among the stages.
    """


def cubic_dense(weights: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Return the dense output of order three: the cubic through both ends and their slopes.

    weights : (stages - 1,) b of a method whose last stage is its FSAL one.
    """
    rows = [[0.0, 3.0 * b, -2.0 * b] for b in (*weights, 0.0)]
    for row, slope in ((rows[0], (1.0, -2.0, 1.0)), (rows[-1], (0.0, -1.0, 1.0))):
        for k, coefficient in enumerate(slope):
            row[k] += coefficient
    return tuple(tuple(row) for row in rows)
