"""Nodes of a trace that outputs need, in the order of evaluation."""

from collections.abc import Container, Iterable

from jointplay.solver.kernels.trace.tracer import Expression


def reachable(outputs: Iterable[Expression], known: Container[Expression] = ()) -> list[Expression]:
    """Return the nodes that outputs need, each after its arguments; fixed nodes are leaves.

    So are `known` nodes.

    A fixed node comes where it is first used, so that the order, and with it the source, does not
    depend on what the scene's numbers are computed from.
    """
    wanted = list(outputs)
    found: dict[int, Expression] = {}
    waiting = list(wanted)
    while waiting:
        node = waiting.pop()
        if node.index in found:
            continue
        found[node.index] = node
        if not (node.fixed or node in known):
            waiting.extend(node.arguments)
    ordered: dict[int, Expression] = {}
    for node in (found[index] for index in sorted(found) if not found[index].fixed):
        needed = () if node in known else node.arguments
        for argument in (*needed, node):
            ordered.setdefault(argument.index, argument)
    for node in wanted:
        ordered.setdefault(node.index, node)
    return list(ordered.values())
