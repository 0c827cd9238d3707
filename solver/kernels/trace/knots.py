"""Knots that a step may meet: where a function that slopes depend on has a derivative that jumps.

A function of a clock meets its knots at times that are known before the step. One of how the
mechanism lies or moves meets them where the motion does.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression, Knots


@dataclass(frozen=True)
class KnotsOnPath:
    """Knots of one argument, and the rate of that argument along the motion."""

    knots: Knots
    rate: Expression
    """Rate of the argument; that of a clock depends on the scene's numbers alone."""

    @property
    def clocked(self) -> bool:
        """True if the argument is a clock."""
        return self.rate.fixed


def knots_on_path(
    rates: Iterable[Expression], derivative: Callable[[Expression], Expression]
) -> tuple[KnotsOnPath, ...]:
    """Return the knots of all functions that some rates depend on, each set once.

    `derivative` : of an expression along the motion.
    """
    found: dict[tuple[object, ...], Knots] = {}
    for node in reachable(rates):
        knots = node.tracer.knots.get(node)
        if knots is None:
            continue
        key = (knots.argument, knots.positions, knots.span)
        jumps = knots.jumps or (key in found and found[key].jumps)
        found[key] = replace(knots, jumps=jumps)
    paths = [KnotsOnPath(knots, derivative(knots.argument)) for knots in found.values()]
    return tuple(path for path in paths if not path.rate.is_literal(0.0))
