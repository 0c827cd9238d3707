"""The classical Runge-Kutta method of order four, with a fixed step and no error estimate.

Its fifth stage is the slope where the step ends, for the dense output of order three.

Source: Kutta 1901, Zeitschrift für Mathematik und Physik 46:435.
"""

from jointplay.solver.integrators.method import Method, cubic_dense

_WEIGHTS = (1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0)

RUNGE_KUTTA4 = Method(
    name="rk4",
    order=4,
    error_order=0,
    dense_order=3,
    nodes=(0.0, 0.5, 0.5, 1.0, 1.0),
    matrix=((), (0.5,), (0.0, 0.5), (0.0, 0.0, 1.0), _WEIGHTS),
    error=(),
    dense=cubic_dense(_WEIGHTS),
)
