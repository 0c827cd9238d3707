"""Closes loops where a step ends, and says whether the step had to be moved too far for that."""

from collections.abc import Callable

from jointplay.solver.kernels.emit.emit import FixedNodes, Output, lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.scalars import Scalar, select_positive

MOVED = 0.01
"""Share of a step's way by which closing loops may move its end."""
ROUNDED = 1e-15
"""Rounding of a state: a share of 1 m or 1 rad, a second in speeds, and of the state itself. Until
something moves, tolerances are smaller than that."""


def source(equations: Equations, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of project(W): moves the stage to where loops are closed.

    ``correction`` keeps by how much; dense output ends at the projected stage with it.
    """
    outputs: list[Output] = []
    for i, correction in enumerate(equations.corrections):
        stage = equations.tracer.variable(f"stage{i}")
        outputs += [(f"correction{i}", correction), (f"stage{i}", stage + correction)]
    return lane_function("project", outputs, layout, fixed)


def drift(v: Callable[[str], Expression], coordinates: int) -> Scalar:
    """Return the square of how far the step's end was moved: in tolerances, at most one.

    Or in shares of the step's own way: where assemblies meet, rounding alone moves it by more than
    a small tolerance, but a step that ends in another assembly was moved far. What rounding alone
    moves it by does not count.
    """
    total: Scalar = 0.0
    for first, speeds_to_states in ((0, v("tried")), (coordinates, 1.0)):
        moved: Scalar = 0.0
        way: Scalar = 0.0
        for i in range(coordinates):
            weight = (v("full") / v("fastest")) * v(f"weight{first + i}")
            correction = _beyond_rounding(v, first + i) * weight
            motion = speeds_to_states * v(f"stage{coordinates + i}") * weight
            moved, way = moved + correction * correction, way + motion * motion
        total = total + moved / (1.0 + MOVED * MOVED * way)
    return total


def _beyond_rounding(v: Callable[[str], Expression], i: int) -> Expression:
    """Return by how much state i was moved, 0 where that may be rounding; NaN stays NaN."""
    correction = v(f"correction{i}")
    within = ROUNDED * (1.0 + abs(v(f"stage{i}"))) - abs(correction)
    return select_positive(within, 0.0, correction)
