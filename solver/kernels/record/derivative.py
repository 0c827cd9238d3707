"""The derivative of recorded expressions along a direction: what tangent vectors follow.

Forward mode on the recorded graph: every node gets one more node, its rate of change when the
variables change along given directions. The recorder's own simplification drops what is zero, and
hash-consing shares the rest, so a derivative costs about as much again as what it differentiates.

Where an expression has no derivative it takes that of the branch in force: a select that of its
chosen value, a floor and the powers of two none at all. A square root at zero counts as constant,
so that the depth of a contact, x sqrt(x), has derivative 0 at its onset and not 0 / 0.
"""

from collections.abc import Callable, Mapping

from jointplay.solver.kernels.record.recorder import Expression

Rule = Callable[[Expression, tuple[Expression, ...]], Expression]
"""From a node and the derivatives of its arguments to its own."""


class Derivative:
    """The derivative along one direction, of any expressions of one recorder.

    Parameters
    ----------
    along
        Rate of change of each variable, by name; a variable that is missing does not change.
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
            return node.recorder.constant(0.0)
        if node.operation == "variable":
            return self._along.get(str(node.data), node.recorder.constant(0.0))
        rates = tuple(self._found[a.index] for a in arguments)
        if all(rate.is_literal(0.0) for rate in rates):
            return node.recorder.constant(0.0)
        known = node.recorder.functions.get(node.index)
        return RULES[known.name if known else node.operation](node, rates)


def _differentiated(node: Expression) -> tuple[Expression, ...]:
    """Return the nodes whose derivatives a node's own is made of."""
    if node.fixed:
        return ()
    known = node.recorder.functions.get(node.index)
    return (known.argument,) if known else node.arguments


def _vanishing(node: Expression) -> Expression | None:
    """Return what a node vanishes with: an expression that is not positive where the node is 0."""
    while True:
        if node.operation == "select":
            return node.arguments[0] if node.arguments[2].is_literal(0.0) else None
        if node.operation in ("neg", "sqrt", "div"):
            node = node.arguments[0]
        elif node.operation == "mul":
            first = _vanishing(node.arguments[0])
            if first is not None:
                return first
            node = node.arguments[1]
        else:
            return None


def _share(factor: Expression, rate: Expression) -> Expression:
    """Return factor * rate; nothing where the factor vanishes, however large the rate is there.

    A journal that hangs in the centre of its bearing has a normal that turns infinitely fast; what
    keeps that out of the equations is that its contact force is 0.
    """
    condition = None if rate.is_literal(0.0) else _vanishing(factor)
    product = factor * rate
    return product if condition is None else condition.select_positive(product, 0.0)


def _product(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    (a, b), (da, db) = node.arguments, rates
    for root, square, rate in ((a, b, db), (b, a, da)):
        if root.operation == "sqrt" and root.arguments[0] is square:
            return 1.5 * root * rate  # x sqrt(x): no division, and 0 at 0
    return _share(b, da) + _share(a, db)


def _quotient(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    (a, b), (da, db) = node.arguments, rates
    if da.is_literal(0.0) and a.is_literal(1.0):
        return -(node * (node * db))
    return (da - node * db) / b


def _root(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    (x,) = node.arguments
    return x.select_positive(0.5 * rates[0] / node, 0.0)


def _choice(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    return node.arguments[0].select_positive(rates[1], rates[2])


def _nothing(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    return node.recorder.constant(0.0)


def _power(node: Expression, rates: tuple[Expression, ...]) -> Expression:
    known = node.recorder.functions[node.index]
    slope = known.partner * node / known.argument
    return known.argument.select_positive(slope * rates[0], 0.0)


def _function(sense: float) -> Rule:
    """Sine (sense 1) and cosine (sense -1), of which each is the other's derivative."""
    return lambda node, rates: sense * node.recorder.functions[node.index].partner * rates[0]


RULES: dict[str, Rule] = {
    "add": lambda node, rates: rates[0] + rates[1],
    "sub": lambda node, rates: rates[0] - rates[1],
    "mul": _product,
    "div": _quotient,
    "neg": lambda node, rates: -rates[0],
    "abs": lambda node, rates: node.arguments[0].select_positive(rates[0], -rates[0]),
    "sqrt": _root,
    "floor": _nothing,
    "select": _choice,
    "exponent_of": _nothing,
    "mantissa_of": lambda node, rates: node / node.arguments[0] * rates[0],
    "power_of_two": _nothing,
    "quarter_turns": lambda node, rates: rates[1].quarter_turns(node.arguments[0], rates[2]),
    "sine": _function(1.0),
    "cosine": _function(-1.0),
    "power": _power,
}
"""Every operation that is emitted, and the functions whose composition the recorder remembers."""
