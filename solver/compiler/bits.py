"""The bits of a float inside kernels: exponent, mantissa, powers of two without a library call."""

# mypy: disable-error-code="no-untyped-def,misc"

from typing import Any

from llvmlite import ir
from numba import float64, types
from numba.extending import intrinsic

DOUBLE, WORD = ir.DoubleType(), ir.IntType(64)
MANTISSA_BITS, BIAS = 52, 1023
MANTISSA_MASK = (1 << MANTISSA_BITS) - 1
ONE = BIAS << MANTISSA_BITS


def _word(value: int) -> ir.Constant:
    return ir.Constant(WORD, value)


@intrinsic
def exponent_of(_typing: Any, x: Any) -> Any:
    """E with x = m 2^e, 1 <= m < 2, for a normal positive x."""

    def generate(_context, builder, _signature, arguments):
        bits = builder.bitcast(arguments[0], WORD)
        shifted = builder.lshr(bits, _word(MANTISSA_BITS))
        return builder.sitofp(builder.sub(shifted, _word(BIAS)), DOUBLE)

    return float64(types.float64), generate


@intrinsic
def mantissa_of(_typing: Any, x: Any) -> Any:
    """M with x = m 2^e, 1 <= m < 2, for a normal positive x."""

    def generate(_context, builder, _signature, arguments):
        bits = builder.bitcast(arguments[0], WORD)
        kept = builder.or_(builder.and_(bits, _word(MANTISSA_MASK)), _word(ONE))
        return builder.bitcast(kept, DOUBLE)

    return float64(types.float64), generate


@intrinsic
def power_of_two(_typing: Any, x: Any) -> Any:
    """2^x for a whole x, limited to -1022..1023; not a number gives the lower limit."""

    def generate(_context, builder, _signature, arguments):
        low, high = ir.Constant(DOUBLE, -1022.0), ir.Constant(DOUBLE, 1023.0)
        above = builder.fcmp_ordered(">", arguments[0], low)
        x = builder.select(above, arguments[0], low)
        below = builder.fcmp_ordered("<", x, high)
        x = builder.select(below, x, high)
        word = builder.add(builder.fptosi(x, WORD), _word(BIAS))
        return builder.bitcast(builder.shl(word, _word(MANTISSA_BITS)), DOUBLE)

    return float64(types.float64), generate
