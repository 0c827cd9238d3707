"""Records what the mechanics compute, as a graph of arithmetic that simplifies as it grows.

A small tracer of our own, not CasADi or SymPy: what is needed is a few simplifications, one
pass of common-subexpression elimination that falls out of hash-consing, a bound on the number of
statements, and control over the text that is emitted; all of it fits here, without a
dependency of 100 MB and without symbolic algebra, whose simplifier takes minutes on a mechanism.

Every operation on an `Expression` returns the node that already stands for the same value, so a
subexpression is evaluated once. Nodes that depend on numbers of the scene alone (`fixed`) are
evaluated once a run, outside the kernel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from jointplay.records.failure import LimitExceeded
from jointplay.solver.kernels.trace.operations import OPERATIONS
from jointplay.solver.kernels.watched import require_wanted
from jointplay.solver.quantities import elementary

MOST_STATEMENTS = 22_000
"""Beyond it compilation takes a minute (40 four-bars need 21 555 in `lagrange`); see
`solver.kinds.compilation`."""

_LOOK = 2048
"""Nodes, some 20 ms, between two questions whether the equations are still wanted."""
COMMUTING = frozenset({"add", "mul"})


class Tracer:
    """Owns the nodes of one trace, `most` of them; derivatives need more than equations."""

    def __init__(self, most: int = 16 * MOST_STATEMENTS) -> None:
        self._most = most
        self._nodes: dict[tuple[object, ...], Expression] = {}
        self.numbers: dict[str, float] = {}
        self.functions: dict[int, Function] = {}
        """Functions of one expression, by the node that stands for each."""
        self.held: dict[Expression, Expression] = {}
        """Inverses of variables that do not change within a step, by variable; see `hold`."""
        self.kinks: dict[Expression, Expression] = {}
        """Piecewise linear functions and their arguments, in the order of tracing."""
        self.knots: dict[Expression, Knots] = {}
        """Functions that are smooth between knots, in the order of tracing."""

    def constant(self, value: float) -> Expression:
        """Return the node of a literal number; minus zero is zero."""
        return self.node("constant", (), float(value) + 0.0, fixed=True)

    def number(self, name: str, value: float) -> Expression:
        """Return the node of a number of the scene, data of a run; `value` serves as its sample."""
        self.numbers[name] = value
        return self.node("number", (), name, fixed=True)

    def variable(self, name: str) -> Expression:
        """Return the node of a quantity that changes while running: state, time, mode."""
        return self.node("variable", (), name, fixed=False)

    def hold(self, name: str) -> Expression:
        """Return a variable that keeps its value in a step; dividing by it takes one inverse."""
        variable = self.variable(name)
        self.held[variable] = self.apply("div", self.constant(1.0), variable)
        return variable

    def lift(self, value: object) -> Expression:
        """Return a node for a float, or the expression itself."""
        if isinstance(value, Expression):
            return value
        return self.constant(float(value))  # type: ignore[arg-type]

    def node(
        self, operation: str, arguments: tuple[Expression, ...], data: object, *, fixed: bool
    ) -> Expression:
        """Return the one node of this operation on these arguments."""
        ordered = arguments
        if operation in COMMUTING:
            one, other = arguments
            if (one.fixed, other.index) < (other.fixed, one.index):
                ordered = (other, one)
        key = (operation, *(e.index for e in ordered), data)
        found = self._nodes.get(key)
        if found is None:
            if len(self._nodes) >= self._most:
                raise too_many(len(self._nodes))
            found = Expression(self, len(self._nodes), operation, ordered, data, fixed)
            self._nodes[key] = found
            if len(self._nodes) % _LOOK == 0:
                require_wanted()
        return found

    def apply(self, operation: str, *arguments: Expression) -> Expression:
        """Return the node of an operation, folded where all arguments are literals."""
        fixed = all(e.fixed for e in arguments)
        if fixed and all(e.operation == "constant" for e in arguments):
            return self.constant(OPERATIONS[operation].on_floats(*(e.value for e in arguments)))
        return self.node(operation, arguments, None, fixed=fixed)


def too_many(count: int) -> LimitExceeded:
    """Return the refusal of a scene whose equations are too long to compile."""
    return LimitExceeded.at(
        "/scene",
        f"The equations of this scene take {count} traced statements or more; the limit is"
        f" {MOST_STATEMENTS}. Use fewer bodies.",
    )


@dataclass(frozen=True, eq=False, slots=True)
class Expression:
    """A node: an operation on other nodes. Arithmetic on it adds more nodes."""

    tracer: Tracer = field(repr=False)
    index: int
    operation: str
    arguments: tuple[Expression, ...] = field(repr=False)
    data: object
    fixed: bool

    @property
    def value(self) -> float:
        """The number of a literal."""
        assert isinstance(self.data, float)  # noqa: S101  (literals only; narrows the type)
        return self.data

    def is_literal(self, value: float) -> bool:
        """Whether this is the literal `value`."""
        return self.operation == "constant" and self.data == value

    def __add__(self, other: object) -> Expression:
        b = self.tracer.lift(other)
        if self.is_literal(0.0):
            return b
        if b.is_literal(0.0):
            return self
        if b.operation == "neg":
            return self - b.arguments[0]
        if self.operation == "neg":
            return b - self.arguments[0]
        return self.tracer.apply("add", self, b)

    __radd__ = __add__

    def __neg__(self) -> Expression:
        if self.operation == "neg":
            return self.arguments[0]
        if self.operation == "sub":
            return self.tracer.apply("sub", self.arguments[1], self.arguments[0])
        return self.tracer.apply("neg", self)

    def __sub__(self, other: object) -> Expression:
        b = self.tracer.lift(other)
        if b.is_literal(0.0):
            return self
        if self.is_literal(0.0):
            return -b
        if self is b:
            return self.tracer.constant(0.0)
        if b.operation == "neg":
            return self + b.arguments[0]
        return self.tracer.apply("sub", self, b)

    def __rsub__(self, other: object) -> Expression:
        return self.tracer.lift(other) - self

    def __mul__(self, other: object) -> Expression:
        a, b = self, self.tracer.lift(other)
        if a.is_literal(0.0) or b.is_literal(0.0):
            return self.tracer.constant(0.0)
        for one, rest in ((a, b), (b, a)):
            if one.is_literal(1.0):
                return rest
            if one.is_literal(-1.0):
                return -rest
            if one.operation == "neg":
                return -(one.arguments[0] * rest)
        return self.tracer.apply("mul", a, b)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Expression:
        b = self.tracer.lift(other)
        if self.is_literal(0.0) or b.is_literal(1.0):
            return self
        if b in self.tracer.held:
            return self * self.tracer.held[b]
        if b.fixed and not self.fixed:
            return self * (self.tracer.constant(1.0) / b)
        return self.tracer.apply("div", self, b)

    def __rtruediv__(self, other: object) -> Expression:
        return self.tracer.lift(other) / self

    def __abs__(self) -> Expression:
        return self.tracer.apply("abs", self)

    def sqrt(self) -> Expression:
        """Square root."""
        return self.tracer.apply("sqrt", self)

    def floor(self) -> Expression:
        """Return the largest whole number that is not above this."""
        return self.tracer.apply("floor", self)

    def select_positive(self, if_positive: object, otherwise: object) -> Expression:
        """`if_positive` where x > 0, else `otherwise`."""
        a, b = self.tracer.lift(if_positive), self.tracer.lift(otherwise)
        if a is b:
            return a
        if self.operation == "constant":
            return a if self.value > 0.0 else b
        return self.tracer.apply("select", self, a, b)

    def sine_cosine(self) -> tuple[Expression, Expression]:
        """Sine and cosine by arithmetic of our own; outside the kernel where x is fixed."""
        if self.fixed:
            return self.tracer.apply("sin", self), self.tracer.apply("cos", self)
        sine, cosine = elementary.sine_cosine(self)
        self.tracer.functions[sine.index] = Function("sin", self, cosine)
        self.tracer.functions[cosine.index] = Function("cos", self, sine)
        return sine, cosine

    def kinked(self, argument: Expression) -> Expression:
        """Note that this is a piecewise linear function of one expression."""
        if not self.fixed:
            self.tracer.kinks[self] = argument
        return self

    def knotted(
        self, argument: object, knots: Sequence[object], span: object | None, *, jumps: bool
    ) -> Expression:
        """Note that this is a function of one expression, smooth between knots."""
        lift = self.tracer.lift
        if not self.fixed:
            positions = tuple(lift(knot) for knot in knots)
            period = None if span is None else lift(span)
            self.tracer.knots[self] = Knots(lift(argument), positions, period, jumps)
        return self

    def power(self, exponent: object) -> Expression:
        """X ** exponent for x >= 0 by arithmetic of our own."""
        lifted = self.tracer.lift(exponent)
        if self.fixed and lifted.fixed:
            return self.tracer.apply("pow", self, lifted)
        result = elementary.power(self, lifted)
        if lifted.fixed:
            self.tracer.functions[result.index] = Function("pow", self, lifted)
        return result

    def logarithm(self) -> Expression:
        """Natural logarithm by arithmetic of our own; outside the kernel where x is fixed."""
        return self._function("log", elementary.log)

    def exponential(self) -> Expression:
        """Exponential by arithmetic of our own; outside the kernel where x is fixed."""
        return self._function("exp", elementary.exp)

    def _function(self, name: str, on_lanes: Callable[[Expression], Expression]) -> Expression:
        if self.fixed:
            return self.tracer.apply(name, self)
        result = on_lanes(self)
        self.tracer.functions[result.index] = Function(name, self, self)
        return result


@dataclass(frozen=True)
class Function:
    """Function that a node stands for, traced as arithmetic: derivatives need not go there.

    `partner` : the cosine of a sine and the sine of a cosine; the exponent of a power; else the
    argument.
    """

    name: str
    argument: Expression
    partner: Expression


@dataclass(frozen=True)
class Knots:
    """Knots of a function of one expression: where a derivative jumps."""

    argument: Expression
    positions: tuple[Expression, ...]
    """In ascending order."""
    span: Expression | None
    """Length of the argument after which they repeat: from the first to the last; None: never."""
    jumps: bool
    """Whether the function's value may jump there."""
