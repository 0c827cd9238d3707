"""A Runge-Kutta method is data: its Butcher tableau, embedded error weights, dense output."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Tableau:
    """An explicit method whose last stage is the first of the next step (FSAL).

    Attributes
    ----------
    nodes : (stages,) c
    matrix : row s holds the s coefficients a of stage s; the last row is the solution's weights b
    error : (stages,) weights of the embedded error estimate; none: the step is fixed
    dense : (stages, degree) dense[i][k] multiplies θ^(k+1) in b_i(θ), 0 <= θ <= 1
    error_order : order of the step's local error estimate plus one: err ~ h^error_order
    dense_order : order of the dense output; its error inside a step is ~ h^(dense_order + 1)
    largest_tolerance : beyond it, the energy that went astray in a revolution of the press was more
        than 5 % of what contacts and friction took in one of 16 presses
    coarse_error : (stages,) weights of a second estimate E of lower order, if any. It corrects the
        first, e, which alone is far too careful: err = |e|² / sqrt(|e|² + |E|² / 100).
    """

    name: str
    order: int
    error_order: int
    dense_order: int
    nodes: tuple[float, ...]
    matrix: tuple[tuple[float, ...], ...]
    error: tuple[float, ...]
    dense: tuple[tuple[float, ...], ...]
    largest_tolerance: float = 0.0
    coarse_error: tuple[float, ...] = ()

    @property
    def stages(self) -> int:
        """Number of stages, the FSAL one included."""
        return len(self.nodes)

    def evaluations(self, states: int) -> int:
        """Return the evaluations of the equations in a step, whatever the number of states."""
        return self.stages - 1


def cubic_dense(weights: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Return the dense output of order three: the cubic through both ends and their slopes.

    weights : (stages - 1,) b of a method whose last stage is its FSAL one.
    """
    rows = [[0.0, 3.0 * b, -2.0 * b] for b in (*weights, 0.0)]
    for row, slope in ((rows[0], (1.0, -2.0, 1.0)), (rows[-1], (0.0, -1.0, 1.0))):
        for k, coefficient in enumerate(slope):
            row[k] += coefficient
    return tuple(tuple(row) for row in rows)
