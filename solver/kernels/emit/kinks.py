"""Kinks inside a step: the mean slope that a tangent vector takes where a law bends or jumps.

Friction turns from full one way to full the other within less slip than a step may bring. What a
tangent loses there depends on how long the slip takes through the bend, and the few stages of a
step do not see when it began. Where a step passes a kink, the slope is the change of value over
the change of argument in it: exact for an argument that changes at a constant rate. A law may even
jump (equal limit velocities), if its argument goes on through the jump; where friction holds the
slip at the jump, the mean slope grows beyond bounds and no tangent can be carried.
"""

from jointplay.solver.kernels.emit.emit import FixedNodes, Output, lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression

Kinks = tuple[tuple[Expression, Expression], ...]
"""Piecewise linear functions, each with its argument."""

MEMORY = 3
"""Numbers kept of a kink at the end of a step, for the next one: argument, value, slope."""
ROUNDING = 1e-9
"""Share of a value by which it may leave a straight line without having passed a kink."""


def kinks_of(equations: Equations) -> Kinks:
    """Return the piecewise linear functions that slopes depend on."""
    needed = {node.index for node in reachable(rate for _, rate in equations.slopes)}
    kinks = equations.tracer.kinks
    return tuple((value, kinks[value]) for value in kinks if value.index in needed)


def allocate(layout: Layout, kinks: int) -> None:
    """Give slots to what is known of kinks at both ends of a step, and over it."""
    layout.add_block("kink_start", MEMORY * kinks)
    layout.add_block("kink_end", MEMORY * kinks)
    layout.add_block("kink_passed", kinks)
    layout.add_block("kink_mean", kinks)


def kink_function(kinks: Kinks, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of kinks(W): which kinks this step passes, and the mean slopes.

    Its end is the state to come, in the base's stage; its start was the end of the step before.
    """
    if not kinks:
        return Source("kinks")
    outputs: list[Output] = []
    for q, (value, argument) in enumerate(kinks):
        tracer = value.tracer
        memory = range(MEMORY * q, MEMORY * (q + 1))
        end = (argument, value, _slope(value, argument))
        start, first, slope = (tracer.variable(f"kink_start{i}") for i in memory)
        turned = abs(value - first - slope * (argument - start))
        rounding = ROUNDING * (abs(value) + abs(first))
        jumped = (turned - rounding).select_positive(turned, 0.0)
        outputs += [(f"kink_end{i}", part) for i, part in zip(memory, end, strict=True)]
        outputs.append((f"kink_passed{q}", abs(end[2] - slope) + jumped))
        outputs.append((f"kink_mean{q}", (value - first) / (argument - start)))
    return lane_function("kinks", outputs, layout, fixed)


def take_mean_slopes(derivative: Derivative, kinks: Kinks) -> None:
    """Let a derivative take the mean slopes of kinks that the step passes."""
    for q, (value, argument) in enumerate(kinks):
        passed = value.tracer.variable(f"kink_passed{q}")
        mean = value.tracer.variable(f"kink_mean{q}")
        slope = passed.select_positive(mean, _slope(value, argument))
        derivative.assume(value, slope * derivative(argument))


def _slope(value: Expression, argument: Expression) -> Expression:
    """Slope of a function of one expression where that is."""
    derivative = Derivative({})
    derivative.assume(argument, value.tracer.constant(1.0))
    return derivative(value)
