"""The derivative of traced expressions along a direction: what tangent vectors follow.

Forward mode on the traced graph: every node gets one more node, its rate of change when the
variables change along given directions. The tracer's own simplification drops what is zero, and
hash-consing shares the rest, so a derivative costs about as much again as what it differentiates.
"""

from collections.abc import Mapping

from jointplay.solver.kernels.trace.operations import OPERATIONS
from jointplay.solver.kernels.trace.tracer import Expression


class Derivative:
    """The derivative along one direction, of any expressions of one tracer.

    `along` : rate of change of each variable, by name; one that is missing does not change.
    """

    def __init__(self, along: Mapping[str, Expression]) -> None:
        self._along = along
        self._found: dict[int, Expression] = {}

    def assume(self, node: Expression, rate: Expression) -> None:
        """Take a node's rate of change as given, instead of deriving it."""
        self._found[node.index] = rate

    def __call__(self, node: Expression) -> Expression:
        """Return the rate of change of an expression."""
        waiting = [node]
        while waiting:  # a graph is deeper than Python's stack
            top = waiting[-1]
            arguments = _differentiated(top)
            unknown = [a for a in arguments if a.index not in self._found]
            if top.index in self._found:
                waiting.pop()
            elif unknown:
                waiting.extend(unknown)
            else:
                self._found[top.index] = self._derive(top, arguments)
                waiting.pop()
        return self._found[node.index]

    def _derive(self, node: Expression, arguments: tuple[Expression, ...]) -> Expression:
        if node.fixed:
            return node.tracer.constant(0.0)
        if node.operation == "variable":
            return self._along.get(str(node.data), node.tracer.constant(0.0))
        rates = tuple(self._found[a.index] for a in arguments)
        if all(rate.is_literal(0.0) for rate in rates):
            return node.tracer.constant(0.0)
        known = node.tracer.functions.get(node.index)
        return OPERATIONS[known.name if known else node.operation].rate(node, rates)


def _differentiated(node: Expression) -> tuple[Expression, ...]:
    """Return the nodes whose derivatives a node's own is made of."""
    if node.fixed:
        return ()
    known = node.tracer.functions.get(node.index)
    return (known.argument,) if known else node.arguments
