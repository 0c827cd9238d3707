"""A Rosenbrock method is data: an implicit method that solves linear equations only."""

from dataclasses import dataclass

from jointplay.solver.integrators.method import Method


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

    def evaluations(self, states: int) -> int:
        """Return the evaluations in a step: stages, ledger and end, and a derivative each way."""
        return len(self.nodes) + 2 + states + 1
