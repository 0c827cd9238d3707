"""Kinks inside a step: the mean slope that a tangent vector takes where a law bends or jumps.

Friction turns from full one way to full the other within less slip than a step may bring. What a
tangent loses there depends on how long the slip takes through the bend, and the few stages of a
step do not see when it began. Where a step passes a kink, the slope is its mean over time: the
change of value over that of argument if the argument changes at a constant rate.

Friction slows a slip in its bend, so that more of the step's time is spent there than of its way.
If nothing else changes, the rate of the slip is linear in the value of the law, and the mean slope
is the change of value over the length of the step and the logarithmic mean of the rates at its
ends. That is taken where the rate falls; where it grows or turns round, a force or a contact has
changed it, and the rate is taken to be constant.

A law may even jump (equal limit velocities), if its argument goes on through the jump; where
friction holds the slip at the jump, the mean slope grows beyond bounds and no tangent can be
carried.
"""

from jointplay.solver.kernels.emit.emit import FixedNodes, Output, lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.scalars import Scalar, logarithm, select_positive

Kinks = tuple[tuple[Expression, Expression], ...]
"""Piecewise linear functions, each with its argument."""

MEMORY = 4
"""Numbers kept of a kink at the end of a step, for the next one: argument, value, slope, and the
rate of the argument."""
ALIKE = 1e-3
"""Relative difference of two rates below which their logarithmic mean is a series: the next term is
1e-14 of it."""
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


def kink_function(kinks: Kinks, motion: Derivative, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of kinks(W): which kinks this step passes, and the mean slopes.

    Its end is the state to come, in the base's stage; its start was the end of the step before.
    motion : derivative in time at the state to come.
    """
    if not kinks:
        return Source("kinks")
    outputs: list[Output] = []
    for q, (value, argument) in enumerate(kinks):
        tracer = value.tracer
        memory = range(MEMORY * q, MEMORY * (q + 1))
        end = (argument, value, _slope(value, argument), motion(argument))
        start, first, slope, rate = (tracer.variable(f"kink_start{i}") for i in memory)
        turned = abs(value - first - slope * (argument - start))
        rounding = ROUNDING * (abs(value) + abs(first))
        jumped = (turned - rounding).select_positive(turned, 0.0)
        outputs += [(f"kink_end{i}", part) for i, part in zip(memory, end, strict=True)]
        outputs.append((f"kink_passed{q}", abs(end[2] - slope) + jumped))
        way = _way(argument - start, rate, end[3], tracer.variable("tried"))
        outputs.append((f"kink_mean{q}", (value - first) / way))
    return lane_function("kinks", outputs, layout, fixed)


def _way(chord: Expression, first: Expression, last: Expression, length: Expression) -> Scalar:
    """Return the change of an argument that goes at the mean rate of its bend all the time.

    chord : its change over the step, whose length is in s. first, last : its rates at both ends.
    """
    ratio = last / first
    more = ratio - 1.0
    series = 1.0 + more * (0.5 - more * (1.0 / 12.0 - more / 24.0))
    mean = select_positive(abs(more) - ALIKE, more / logarithm(ratio), series)
    falls = select_positive(abs(first) - abs(last), first * last, 0.0)
    return select_positive(falls, length * first * mean, chord)


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
