"""Nodes of a trace that outputs need, in the order of evaluation."""

from collections.abc import Callable, Container, Iterable

from jointplay.solver.kernels.trace.tracer import Expression


def reachable(outputs: Iterable[Expression], known: Container[Expression] = ()) -> list[Expression]:
    """Return the nodes that outputs need, each after its arguments; fixed nodes are leaves.

    So are `known` nodes.

    A fixed node comes where it is first used, so that the order, and with it the source, does not
    depend on what the scene's numbers are computed from.
    """
    wanted = list(outputs)
    ordered: dict[int, Expression] = {}
    for node in with_arguments(wanted, lambda node: node.fixed or node in known):
        if not node.fixed:
            needed = () if node in known else node.arguments
            for argument in (*needed, node):
                ordered.setdefault(argument.index, argument)
    for node in wanted:
        ordered.setdefault(node.index, node)
    return list(ordered.values())


def with_arguments(
    outputs: Iterable[Expression], is_leaf: Callable[[Expression], bool] = lambda _: False
) -> list[Expression]:
    """Return nodes and all that they need, down to leaves, each behind its arguments."""
    found: dict[int, Expression] = {}
    waiting = list(outputs)
    while waiting:
        node = waiting.pop()
        if node.index not in found:
            found[node.index] = node
            if not is_leaf(node):
                waiting.extend(node.arguments)
    return [found[index] for index in sorted(found)]  # nodes come behind their arguments
