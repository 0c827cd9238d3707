"""Writes recorded expressions as Python source: one straight line of arithmetic over eight lanes.

What makes the loop vectorise was measured: no library call, no branch but selects, and one flat
array with constant offsets, so that the compiler needs no run-time check for aliasing.
Names in the source are the emitter's own; nothing of a scene's text enters it.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from types import MappingProxyType

from solver.compiler.layout import LANES, Layout
from solver.compiler.recorder import MOST_STATEMENTS, Expression, too_many
from solver.errors import LimitExceeded

FORMATS = {
    "add": "{} + {}",
    "sub": "{} - {}",
    "mul": "{} * {}",
    "div": "{} / {}",
    "neg": "-{}",
    "abs": "abs({})",
    "sqrt": "sqrt({})",
    "floor": "floor({})",
    "select": "{1} if {0} > 0.0 else {2}",
    "exponent_of": "exponent_of({})",
    "mantissa_of": "mantissa_of({})",
    "power_of_two": "power_of_two({})",
}

HEADER = '''"""A generated kernel: see solver.compiler."""

from math import sqrt

from numba import float64, int64, njit, void
from numpy import floor

from solver.compiler.bits import exponent_of, mantissa_of, power_of_two

options = {"cache": True, "error_model": "numpy", "fastmath": {"contract", "nsz", "arcp"}}
'''
DECORATOR = "@njit(void(float64[::1]), **options)"
RETURNING = "@njit(float64(float64[::1]), **options)"
PROBING = "@njit(void(float64[::1], float64[::1], int64), **options)"


class FixedNodes:
    """Expressions of the scene's numbers alone that kernels load instead of computing."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.nodes: dict[int, Expression] = {}

    def slot(self, node: Expression) -> int:
        """Return the slot that holds the node's value, giving it one on first use."""
        name = f"fixed{node.index}"
        if name not in self.layout:
            self.layout.add(name)
            self.nodes[node.index] = node
        return self.layout[name]


class _Body:
    """The statements of one lane's loop."""

    def __init__(self, layout: Layout, fixed: FixedNodes | None, known: Mapping[int, str]) -> None:
        self.layout = layout
        self.fixed = fixed
        self.known = known
        self.lines: list[str] = []
        self.names: dict[int, str] = {}

    def place(self, slot: int) -> str:
        return f"W[{slot * LANES} + l]"

    def define(self, node: Expression, text: str) -> None:
        # numbered as they come, so that equal equations make equal sources
        self.names[node.index] = f"v{len(self.names)}"
        self.lines.append(f"        {self.names[node.index]} = {text}")

    def operand(self, node: Expression) -> str:
        if node.operation == "constant":
            return f"({node.value!r})" if node.value < 0.0 else repr(node.value)
        if node.index not in self.names and self.fixed is not None:
            self.define(node, self.place(self.fixed.slot(node)))
        return self.names[node.index]

    def state(self, node: Expression) -> None:
        if node.index in self.known:
            self.define(node, self.place(self.layout[self.known[node.index]]))
        elif node.operation == "variable":
            self.define(node, self.place(self.layout[str(node.data)]))
        elif not node.fixed:
            arguments = [self.operand(argument) for argument in node.arguments]
            self.define(node, FORMATS[node.operation].format(*arguments))


def lane_function(
    name: str,
    outputs: Sequence[tuple[str, Expression]],
    layout: Layout,
    fixed: FixedNodes | None = None,
    known: Mapping[int, str] = MappingProxyType({}),
) -> str:
    """Return the source of a function W -> W that evaluates `outputs` (slot name, expression).

    `known` : nodes, by index, that a function called before has left in a slot.

    Raises
    ------
    LimitExceeded
        More statements than can be compiled in reasonable time.
    """
    ordered = reachable((expression for _, expression in outputs), known)
    if len(ordered) > MOST_STATEMENTS:
        raise LimitExceeded([too_many(len(ordered))])
    body = _Body(layout, fixed, known)
    for node in ordered:
        body.state(node)
    values = [body.operand(expression) for _, expression in outputs]
    stores = [
        f"        {body.place(layout[slot_name])} = {value}"
        for (slot_name, _), value in zip(outputs, values, strict=True)
    ]
    header = [DECORATOR, f"def {name}(W):", f"    for l in range({LANES}):"]
    return "\n".join([*header, *body.lines, *stores]) + "\n"


def nothing(name: str) -> str:
    """Return the source of a function W -> W that does nothing."""
    return f"{DECORATOR}\ndef {name}(W):\n    pass\n"


def reachable(outputs: Iterable[Expression], known: Container[int] = ()) -> list[Expression]:
    """Return the nodes that outputs need, each after its arguments; fixed nodes are leaves.

    So are `known` nodes, given by their indices.

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
        if not (node.fixed or node.index in known):
            waiting.extend(node.arguments)
    ordered: dict[int, Expression] = {}
    for node in (found[index] for index in sorted(found) if not found[index].fixed):
        needed = () if node.index in known else node.arguments
        for argument in (*needed, node):
            ordered.setdefault(argument.index, argument)
    for node in wanted:
        ordered.setdefault(node.index, node)
    return list(ordered.values())
