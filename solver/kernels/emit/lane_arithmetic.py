"""The arithmetic of tapes on vectors of lanes, in the compiler's own intermediate language.

Nothing is reassociated; products and sums may become one operation (contract), the
sign of zero does not matter (nsz), a division may become a product (arcp).
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils

from jointplay.solver.kernels.lanes import LANES

DOUBLE, WORD = ir.DoubleType(), ir.IntType(64)
NUMBERS, WORDS = ir.VectorType(DOUBLE, LANES), ir.VectorType(WORD, LANES)
MARKS, PLACE = ir.IntType(8), ir.IntType(32)
FLAGS = ("contract", "nsz", "arcp")
MANTISSA_BITS, BIAS = 52, 1023
MANTISSA_MASK = (1 << MANTISSA_BITS) - 1
ONE = BIAS << MANTISSA_BITS
SIGN = 1 << 63
WHOLE = 1.5 * 2.0**MANTISSA_BITS
"""A number so large that the lowest bits of what is added are whole numbers' own."""


def same(value: float) -> Any:
    """Return one number in every lane."""
    return ir.Constant(NUMBERS, [value] * LANES)


def _word(value: int) -> Any:
    return ir.Constant(WORDS, [value] * LANES)


def _library(name: str) -> Callable[..., Any]:
    """Return a function of the processor's own: no call is left of it."""

    def call(builder, x):
        kind = ir.FunctionType(NUMBERS, [NUMBERS])
        name_there = f"llvm.{name}.v{LANES}f64"
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name_there), [x])

    return call


def _greater(builder, x, y):
    return builder.fcmp_ordered(">", x, y)


def _select(builder, x, a, b):
    """Return a where x > 0, else b; a difference is compared, not formed: it may be a maximum."""
    if getattr(x, "opname", "") == "fsub":
        return builder.select(_greater(builder, *x.operands), a, b)
    return builder.select(_greater(builder, x, same(0.0)), a, b)


def _exponent_of(builder, x):
    """Return e with x = m 2^e, 1 <= m < 2, for a normal positive x."""
    shifted = builder.lshr(builder.bitcast(x, WORDS), _word(MANTISSA_BITS))
    return builder.sitofp(builder.sub(shifted, _word(BIAS)), NUMBERS)


def _mantissa_of(builder, x):
    """Return m with x = m 2^e, 1 <= m < 2, for a normal positive x."""
    kept = builder.and_(builder.bitcast(x, WORDS), _word(MANTISSA_MASK))
    return builder.bitcast(builder.or_(kept, _word(ONE)), NUMBERS)


def _power_of_two(builder, x):
    """Return 2^x for a whole x, limited to -1022..1023; NaN gives the lower limit."""
    low, high = same(-1022.0), same(1023.0)
    x = builder.select(_greater(builder, x, low), x, low)
    x = builder.select(_greater(builder, high, x), x, high)
    bits = builder.add(builder.fptosi(x, WORDS), _word(BIAS))
    return builder.bitcast(builder.shl(bits, _word(MANTISSA_BITS)), NUMBERS)


def _quarter_turns(builder, n, sine, cosine):
    """Return the sine of an angle n quarter turns on; |n| < 2^50.

    The lowest bits of n swap both and change the sign, which takes no multiplication.
    """
    bits = builder.bitcast(builder.fadd(n, same(WHOLE)), WORDS)
    odd = builder.icmp_unsigned("!=", builder.and_(bits, _word(1)), _word(0))
    sign = builder.and_(builder.shl(bits, _word(62)), _word(SIGN))
    turned = builder.bitcast(builder.select(odd, cosine, sine), WORDS)
    return builder.bitcast(builder.xor(turned, sign), NUMBERS)


OPERATIONS: dict[str, Callable[..., Any]] = {
    "add": lambda builder, x, y: builder.fadd(x, y, flags=FLAGS),
    "sub": lambda builder, x, y: builder.fsub(x, y, flags=FLAGS),
    "mul": lambda builder, x, y: builder.fmul(x, y, flags=FLAGS),
    "div": lambda builder, x, y: builder.fdiv(x, y, flags=FLAGS),
    "neg": lambda builder, x: builder.fneg(x, flags=FLAGS),
    "abs": _library("fabs"),
    "sqrt": _library("sqrt"),
    "floor": _library("floor"),
    "select": _select,
    "exponent_of": _exponent_of,
    "mantissa_of": _mantissa_of,
    "power_of_two": _power_of_two,
    "quarter_turns": _quarter_turns,
}
"""Vector form of each operation of the recorder."""


def positive(builder, x):
    """Return bit k for each lane k whose number is positive."""
    bits = builder.bitcast(_greater(builder, x, same(0.0)), ir.IntType(LANES))
    return bits if bits.type == MARKS else builder.zext(bits, MARKS)


def everywhere(builder, number):
    """Return a number in every lane."""
    alone = builder.insert_element(ir.Constant(NUMBERS, ir.Undefined), number, PLACE(0))
    return builder.shuffle_vector(alone, alone, _places([0] * LANES))


def lower_and_upper(builder, lower, upper):
    """Return the lower half of one and the upper half of the other."""
    half = LANES // 2
    return builder.shuffle_vector(
        lower, upper, _places([*range(half), *range(LANES + half, 2 * LANES)])
    )


def largest(builder, x):
    """Return the largest of the lanes' numbers, which are all numbers."""
    width = LANES // 2
    while width:
        other = builder.shuffle_vector(x, x, _places([(k + width) % LANES for k in range(LANES)]))
        x = builder.select(_greater(builder, x, other), x, other)
        width //= 2
    return builder.extract_element(x, PLACE(0))


def _places(lanes: list[int]) -> Any:
    return ir.Constant(ir.VectorType(PLACE, LANES), lanes)
