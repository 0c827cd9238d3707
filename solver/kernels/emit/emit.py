"""Writes traced expressions as tapes: straight lines of arithmetic over all lanes.

Measurements say what makes them fast: no library call, no branch but selects, and one work array
with constant offsets. Names on a tape are the emitter's own; nothing of a scene's text enters it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType

from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import MOST_STATEMENTS, Expression, too_many
from jointplay.solver.kernels.watched import require_wanted

LONGEST = 3 * MOST_STATEMENTS
"""Lines of a tape: dense output, equations and channels, each within the limit, are on some."""

Output = tuple[str, Expression]
"""Slot name and what is to be in it."""
Outputs = Sequence[Output]
Known = Mapping[Expression, str]
"""Expressions that a function called before has left in a slot, given by its name."""
NONE: Known = MappingProxyType({})


class FixedNodes:
    """Expressions of the scene's numbers alone that kernels load instead of computing."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.nodes: dict[int, Expression] = {}
        """By slot."""

    def slot(self, node: Expression) -> str:
        """Return the name of the slot that holds the node's value, giving it one on first use."""
        name = f"fixed{node.index}"
        if name not in self.layout:
            self.layout.add(name)
            self.nodes[self.layout[name]] = node
        return name


class Tape:
    """Statements in their order; a value is named by its number, so equal equations look alike.

    `fixed` collects what depends on the scene's numbers alone (None: there is no such expression),
    `known` need not be computed again, `fetch` tells how a slot is read (None: all its lanes).
    """

    def __init__(
        self,
        layout: Layout,
        fixed: FixedNodes | None = None,
        known: Known = NONE,
        fetch: Callable[[str], str] | None = None,
    ) -> None:
        self.layout, self.fixed, self.known = layout, fixed, known
        self.fetch = fetch or (lambda name: f"load {layout[name]}")
        self.lines: list[str] = []
        self.values: dict[Expression, str] = {}
        self._found = set(known)
        """Values that need not be evaluated any more."""
        self.carried: dict[str, str] = {}

    def carry(self, outputs: Outputs) -> None:
        """Evaluate what later statements shall find in slots, though it is not stored there."""
        for name, expression in outputs:
            self.carried[name] = self.evaluate(expression)

    def store(self, outputs: Outputs) -> None:
        """Evaluate outputs, of what slots hold before any is stored, and store each at once.

        To hold all of them until the last is known would take more registers than there are.
        """
        order = {name: i for i, (name, _) in enumerate(outputs)}
        seen = set(self._found)
        for i, (_, expression) in enumerate(outputs):
            for node in reachable([expression], seen):
                if node.operation == "variable" and order.get(str(node.data), i) < i:
                    self.evaluate(node)
                seen.add(node)
        for name, expression in outputs:
            value = self.evaluate(expression)
            self.lines.append(f"store {self.layout[name]} {value}")

    def keep(self, names: Iterable[str]) -> None:
        """Store what is carried."""
        self.lines += [f"store {self.layout[name]} {self.carried[name]}" for name in names]

    def give(self, expression: Expression) -> None:
        """End with the lanes in which an expression is positive as the function's value."""
        self.lines.append(f"return {self.evaluate(expression)}")

    def mark(self, name: str, expression: Expression) -> None:
        """Note the lanes in which an expression is positive, in the row's byte of a block."""
        self.lines.append(f"mark {self.layout[name]} {self.evaluate(expression)}")

    def go_on_where(self, expression: Expression) -> None:
        """Have what follows done only if an expression is positive in any lane."""
        self.lines.append(f"where {self.evaluate(expression)}")

    def take_unless(
        self, condition: Expression, choices: Iterable[tuple[Expression, Expression, Expression]]
    ) -> None:
        """Have values taken for expressions: of each the first, or in all lanes the second.

        The second ones are evaluated only if the condition is positive in any lane; they may depend
        on the expression itself. Each choice is an expression and its two values.
        """
        wanted = list(choices)
        firsts = [self.evaluate(first) for _, first, _ in wanted]
        self.lines.append(f"if {self.evaluate(condition)}")
        values, found = dict(self.values), set(self._found)
        seconds = [self.evaluate(second) for _, _, second in wanted]
        self.values, self._found = values, found
        self.lines.append("end")
        for (node, _, _), first, second in zip(wanted, firsts, seconds, strict=True):
            self._define(node, f"either {second} {first}")

    def store_rows(self, outputs: Outputs) -> None:
        """Evaluate outputs, then store them in the row of blocks, given by their first slots."""
        values = [self.evaluate(expression) for _, expression in outputs]
        for (name, _), value in zip(outputs, values, strict=True):
            self.lines.append(f"store {self.layout[name]}+ {value}")

    def function(self, name: str, over: str = "lanes", rows: int = 0) -> Source:
        """Return the source of a function; see `straight_line` for what it goes over."""
        require_wanted()
        return Source(name, tuple(self.lines), over, rows)

    def evaluate(self, expression: Expression) -> str:
        """Have an expression evaluated here, if it is not yet. Returns the value's name."""
        if expression not in self.values:
            for node in reachable([expression], self._found):
                if node not in self.values:
                    self._state(node)
        return self._operand(expression)

    def _state(self, node: Expression) -> None:
        if node in self.known:
            self._define(node, self.fetch(self.known[node]))
        elif node.operation == "variable":
            name = str(node.data)
            if name in self.carried:
                self._name(node, self.carried[name])
            else:
                self._define(node, self.fetch(name))
        elif not node.fixed:
            arguments = [self._operand(argument) for argument in node.arguments]
            self._define(node, " ".join([node.operation, *arguments]))

    def _operand(self, node: Expression) -> str:
        if node.operation == "constant":
            return repr(node.value)
        if node not in self.values and self.fixed is not None:
            self._define(node, self.fetch(self.fixed.slot(node)))
        return self.values[node]

    def _define(self, node: Expression, text: str) -> None:
        if len(self.lines) >= LONGEST:
            raise too_many(len(self.lines))
        name = f"v{len(self.lines)}"
        self._name(node, name)
        self.lines.append(f"{name} = {text}")

    def _name(self, node: Expression, name: str) -> None:
        self.values[node] = name
        self._found.add(node)


def lane_function(
    name: str,
    outputs: Outputs,
    layout: Layout,
    fixed: FixedNodes | None = None,
    known: Known = NONE,
) -> Source:
    """Return the source of a function W -> W that evaluates `outputs`."""
    tape = Tape(layout, fixed, known)
    tape.store(outputs)
    return tape.function(name)
