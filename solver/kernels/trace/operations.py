"""Operations of traced expressions: one table of what each is on floats, on lanes, derived.

On lanes each is rounded as it is written, but that a sum of a product is rounded once.

Where an operation has no derivative it takes that of the branch in force: a select that of its
chosen value, a floor and the powers of two none at all. A square root at zero counts as constant,
so that the depth of a contact, x sqrt(x), has derivative 0 at its onset and not 0 / 0.
"""

import math
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.solver.quantities import elementary
from jointplay.solver.quantities.elementary import HIGHEST, LOWEST, ON_FLOATS
from jointplay.solver.quantities.scalars import exponential, logarithm, power, sine_cosine

Node = Any
"""An expression of `solver.kernels.trace.tracer`, which uses this table."""
Rates = tuple[Node, ...]
"""Derivatives of a node's arguments."""
Builder = Any
"""Writes code for vectors: `solver.kernels.emit.lane_arithmetic.Builder`."""
Vector = Any
"""A vector of that code, a number a lane."""

MANTISSA_BITS, BIAS = 52, 1023
MANTISSA_MASK = (1 << MANTISSA_BITS) - 1
SIGN_BIT = 63
WHOLE = 1.5 * 2.0**MANTISSA_BITS
"""A number so large that the lowest bits of what is added are whole numbers' own."""


@dataclass(frozen=True)
class Operation:
    """An operation of the tracer."""

    on_floats: Callable[..., float]
    """Its value for numbers."""
    rate: Callable[[Node, Rates], Node]
    """Its derivative, from a node and the derivatives of its arguments."""
    on_lanes: Callable[..., Vector] | None = None
    """Its code, from a builder and vectors; none of what kernels have as arithmetic
    (`solver.quantities.elementary`), whose node and one argument the tracer knows."""


def _arithmetic(instruction: str) -> Callable[..., Vector]:
    """Return what writes an instruction on two vectors."""
    return lambda build, x, y: build.arithmetic(instruction, x, y)


def _nothing(node: Node, _rates: Rates) -> Node:
    return node.tracer.constant(0.0)


def _vanishing(node: Node) -> Node | None:
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


def _share(factor: Node, rate: Node) -> Node:
    """Return factor * rate; nothing where the factor vanishes, however large the rate is there.

    A journal that hangs in the centre of its bearing has a normal that turns infinitely fast; what
    keeps that out of the equations is that its contact force is 0.
    """
    condition = None if rate.is_literal(0.0) else _vanishing(factor)
    product = factor * rate
    return product if condition is None else condition.select_positive(product, 0.0)


def _product_rate(node: Node, rates: Rates) -> Node:
    (a, b), (da, db) = node.arguments, rates
    for root, square, rate in ((a, b, db), (b, a, da)):
        if root.operation == "sqrt" and root.arguments[0] is square:
            return 1.5 * root * rate  # x sqrt(x): no division, and 0 at 0
    return _share(b, da) + _share(a, db)


def _quotient_rate(node: Node, rates: Rates) -> Node:
    (a, b), (da, db) = node.arguments, rates
    if da.is_literal(0.0) and a.is_literal(1.0):
        return -(node * (node * db))
    return (da - node * db) / b


def _root_rate(node: Node, rates: Rates) -> Node:
    (x,) = node.arguments
    return x.select_positive(0.5 * rates[0] / node, 0.0)


def _power_rate(node: Node, rates: Rates) -> Node:
    known = node.tracer.functions[node.index]
    slope = known.partner * node / known.argument
    return known.argument.select_positive(slope * rates[0], 0.0)


def _select(build: Builder, x: Vector, a: Vector, b: Vector) -> Vector:
    """Return a where x > 0, else b."""
    return build.choose(build.positive(x), a, b)


def _exponent(build: Builder, x: Vector) -> Vector:
    """Return e with x = m 2^e, 1 <= m < 2, for a normal positive x."""
    shifted = build.on_words("lshr", build.bits(x), build.word(MANTISSA_BITS))
    return build.from_whole(build.on_words("sub", shifted, build.word(BIAS)))


def _mantissa(build: Builder, x: Vector) -> Vector:
    """Return m with x = m 2^e, 1 <= m < 2, for a normal positive x."""
    kept = build.on_words("and", build.bits(x), build.word(MANTISSA_MASK))
    return build.numbers(build.on_words("or", kept, build.word(BIAS << MANTISSA_BITS)))


def _power_of_two(build: Builder, x: Vector) -> Vector:
    """Return 2^x for a whole x, limited to -1022..1023; NaN gives the lower limit."""
    low, high = build.same(LOWEST), build.same(HIGHEST)
    x = build.choose(build.greater(x, low), x, low)
    x = build.choose(build.greater(high, x), x, high)
    bits = build.on_words("add", build.whole(x), build.word(BIAS))
    return build.numbers(build.on_words("shl", bits, build.word(MANTISSA_BITS)))


def _quarter_turns(build: Builder, n: Vector, sine: Vector, cosine: Vector) -> Vector:
    """Return the sine of an angle n quarter turns on; |n| < 2^50.

    The lowest bits of n swap both and change the sign, which takes no multiplication.
    """
    on_words, word = build.on_words, build.word
    bits = build.bits(build.arithmetic("fadd", n, build.same(WHOLE)))
    odd = on_words("icmp ne", on_words("and", bits, word(1)), word(0))
    sign = on_words("and", on_words("shl", bits, word(SIGN_BIT - 1)), word(1 << SIGN_BIT))
    turned = build.bits(build.choose(odd, cosine, sine))
    return build.numbers(on_words("xor", turned, sign))


OPERATIONS: dict[str, Operation] = {
    "add": Operation(operator.add, lambda _, rates: rates[0] + rates[1], _arithmetic("fadd")),
    "sub": Operation(operator.sub, lambda _, rates: rates[0] - rates[1], _arithmetic("fsub")),
    "mul": Operation(operator.mul, _product_rate, _arithmetic("fmul")),
    "div": Operation(operator.truediv, _quotient_rate, _arithmetic("fdiv")),
    "neg": Operation(operator.neg, lambda _, rates: -rates[0], lambda build, x: build.negative(x)),
    "abs": Operation(
        abs,
        lambda node, rates: node.arguments[0].select_positive(rates[0], -rates[0]),
        lambda build, x: build.call("fabs", x),
    ),
    "sqrt": Operation(math.sqrt, _root_rate, lambda build, x: build.call("sqrt", x)),
    "floor": Operation(ON_FLOATS["floor"], _nothing, lambda build, x: build.call("floor", x)),
    "select": Operation(
        ON_FLOATS["select"],
        lambda node, rates: node.arguments[0].select_positive(rates[1], rates[2]),
        _select,
    ),
    "exponent_of": Operation(ON_FLOATS["exponent_of"], _nothing, _exponent),
    "mantissa_of": Operation(
        ON_FLOATS["mantissa_of"], lambda node, rates: node / node.arguments[0] * rates[0], _mantissa
    ),
    "power_of_two": Operation(ON_FLOATS["power_of_two"], _nothing, _power_of_two),
    "quarter_turns": Operation(
        ON_FLOATS["quarter_turns"],
        lambda node, rates: node.tracer.apply(
            "quarter_turns", node.arguments[0], rates[1], rates[2]
        ),
        _quarter_turns,
    ),
    "sin": Operation(
        lambda x: sine_cosine(x)[0],
        lambda node, rates: node.tracer.functions[node.index].partner * rates[0],
    ),
    "cos": Operation(
        lambda x: sine_cosine(x)[1],
        lambda node, rates: -1.0 * node.tracer.functions[node.index].partner * rates[0],
    ),
    "pow": Operation(power, _power_rate),
    "log": Operation(
        logarithm, lambda node, rates: rates[0] / node.tracer.functions[node.index].argument
    ),
    "exp": Operation(exponential, lambda node, rates: node * rates[0]),
}
"""Every operation by its name on tapes."""


def _powers(x: Any, exponent: Any) -> Any:
    """Return powers with exponents of which some may be the one that has a form of its own."""
    x, exponent = np.broadcast_arrays(x, exponent)
    return np.where(exponent == 1.5, x * np.sqrt(x), power(x, exponent))


ON_ARRAYS: dict[str, Callable[..., Any]] = {
    **elementary.ON_ARRAYS,
    "sqrt": np.sqrt,
    "sin": lambda x: sine_cosine(x + 0.0)[0],
    "cos": lambda x: sine_cosine(x + 0.0)[1],
    "pow": _powers,
}
"""Operations that take other ways on arrays; with the bits of `on_floats`."""


def operate(name: str, operands: Sequence[Any]) -> Any:
    """Return what an operation gives of numbers, of which some may be arrays, (points,)."""
    function = OPERATIONS[name].on_floats
    if any(isinstance(operand, np.ndarray) for operand in operands):
        function = ON_ARRAYS.get(name, function)
    return function(*operands)
