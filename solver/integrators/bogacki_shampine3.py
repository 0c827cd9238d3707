"""Bogacki-Shampine 3(2), four stages, FSAL, with its free dense output of order three.

Source: Bogacki and Shampine 1989, Applied Mathematics Letters 2:321.
"""

from jointplay.solver.integrators.method import Method, cubic_dense

_WEIGHTS = (2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0)

BOGACKI_SHAMPINE3 = Method(
    name="bogacki-shampine",
    order=3,
    error_order=3,
    dense_order=3,
    largest_tolerance=1e-4,
    usual_evaluations=55e3,
    cost_order=3.2,
    nodes=(0.0, 0.5, 0.75, 1.0),
    matrix=((), (0.5,), (0.0, 0.75), _WEIGHTS),
    error=(-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0),
    dense=cubic_dense(_WEIGHTS),
)
