"""An integration method is data: coefficients, and facts that it states of itself."""

from collections.abc import Sequence
from dataclasses import dataclass

LONGEST_SIGHT = 5
"""Order up to which error control keeps steps so short that their ends tell what is between."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """A Runge-Kutta method: its coefficients, its orders, what it may be asked for, what it costs.

    The last stage of an explicit method is the first of the next step (FSAL) and counts among the
    stages; the last row of its `matrix` is the solution's weights b.

    Attributes
    ----------
    nodes : c (explicit) or α (Rosenbrock) of each stage
    matrix : row s holds the s coefficients a of stage s
    error : (stages,) weights of the embedded error estimate; none: the step is fixed
    dense : (stages, degree) dense[i][k] multiplies θ^(k+1) in b_i(θ), 0 <= θ <= 1
    error_order : order of the step's local error estimate plus one: err ~ h^error_order
    dense_order : order of the dense output; its error inside a step is ~ h^(dense_order + 1)
    largest_tolerance : beyond it, the energy residual of a revolution of the press was more
        than 5 % of what contacts and friction took in one of 16 presses; none with a fixed step
    coarse_error : (stages,) weights of a second estimate E of lower order, if any. It corrects the
        first, e, which alone is far too careful: err = |e|² / sqrt(|e|² + |E|² / 100).
    carries_tangents : whether Lyapunov exponents of its runs are offered: they were compared
    usual_evaluations : of the equations in a period of the press at tolerance 1e-6; weighs runs of
        an accuracy-study against each other, so a guess does
    cost_order : those evaluations grow with tolerance^(-1 / cost_order); none: the order
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
    carries_tangents: bool = False
    usual_evaluations: float = 60e3
    cost_order: float | None = None

    @property
    def fixed_step(self) -> bool:
        """Whether there is no error estimate: steps are as long as asked, onsets not located."""
        return not self.error

    @property
    def watched_closely(self) -> bool:
        """Whether a step of a contact may be so long that it has extremes that its ends hide."""
        return self.fixed_step or self.order > LONGEST_SIGHT

    @property
    def stages(self) -> int:
        """Number of slopes or vectors that a step keeps, the one at its start included."""
        return len(self.nodes)

    def evaluations(self, states: int) -> int:
        """Return the evaluations of the equations in a step of a problem with `states` states."""
        return self.stages - 1

    def evaluations_at(self, tolerance: float) -> float:
        """Return about how many evaluations a period of the press takes, with error control."""
        root = self.cost_order or self.order
        return self.usual_evaluations * float(max(1e-6 / tolerance, 0.1) ** (1.0 / root))


@dataclass(frozen=True, kw_only=True)
class Rosenbrock(Method):
    """A Rosenbrock method in the variables V = U / h of Hairer and Wanner 1996, IV.7.

    Stage i solves (I - h γ J) V_i = γ (f(t + α_i h, y + h Σ a_ij V_j) + Σ c_ij V_j + γ_i h f_t).

    Attributes
    ----------
    drifts : (stages,) γ_i
    couplings : row i holds the i coefficients c of stage i
    weights : (stages,) of V in the step's increment over h
    error : (stages,) weights of V in the error estimate over h
    dense : (1 + stages, degree); the first row, of the slope at the start, is empty
    """

    gamma: float
    drifts: tuple[float, ...]
    couplings: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]

    @property
    def stages(self) -> int:
        """Number of vectors that a step keeps: the slope at its start, then the stages."""
        return 1 + len(self.nodes)

    @property
    def watched_closely(self) -> bool:
        """Every step of a contact: friction that a steep ramp holds may sway inside."""
        return True

    def evaluations(self, states: int) -> int:
        """Return the evaluations in a step: stages, ledger and end, and a derivative each way."""
        return len(self.nodes) + 2 + states + 1


def cubic_dense(weights: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Return the dense output of order three: the cubic through both ends and their slopes.

    weights : (stages - 1,) b of a method whose last stage is its FSAL one.
    """
    rows = [[0.0, 3.0 * b, -2.0 * b] for b in (*weights, 0.0)]
    for row, slope in ((rows[0], (1.0, -2.0, 1.0)), (rows[-1], (0.0, -1.0, 1.0))):
        for k, coefficient in enumerate(slope):
            row[k] += coefficient
    return tuple(tuple(row) for row in rows)
