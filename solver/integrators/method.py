"""Facts that every integration method states of itself, whatever its family."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Method:
    """A method as data: its coefficients, its orders, what it may be asked for, what it costs.

    Attributes
    ----------
    nodes : c (explicit) or α (Rosenbrock) of each stage
    matrix : row s holds the s coefficients a of stage s
    error : (stages,) weights of the embedded error estimate; none: the step is fixed
    dense : (stages, degree) dense[i][k] multiplies θ^(k+1) in b_i(θ), 0 <= θ <= 1
    error_order : order of the step's local error estimate plus one: err ~ h^error_order
    dense_order : order of the dense output; its error inside a step is ~ h^(dense_order + 1)
    largest_tolerance : beyond it, the energy that went astray in a revolution of the press was more
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
