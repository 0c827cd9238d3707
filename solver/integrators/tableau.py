"""A Runge-Kutta method is data: its Butcher tableau, embedded error weights, dense output."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Tableau:
    """An explicit method whose last stage is the first of the next step (FSAL).

    Attributes
    ----------
    nodes : (stages,) c
    matrix : row s holds the s coefficients a of stage s; the last row is the solution's weights b
    error : (stages,) weights of the embedded error estimate
    dense : (stages, degree) dense[i][k] multiplies θ^(k+1) in b_i(θ), 0 <= θ <= 1
    error_order : order of the step's local error estimate plus one: err ~ h^error_order
    """

    name: str
    order: int
    error_order: int
    nodes: tuple[float, ...]
    matrix: tuple[tuple[float, ...], ...]
    error: tuple[float, ...]
    dense: tuple[tuple[float, ...], ...]

    @property
    def stages(self) -> int:
        """Number of stages, the FSAL one included."""
        return len(self.nodes)
