"""Vectors of lanes in the compiler's own intermediate language: what operations are built from."""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from functools import cache
from typing import Any

from llvmlite import ir
from numba.core import cgutils

from jointplay.solver.kernels.lanes import LANES

DOUBLE, WORD = ir.DoubleType(), ir.IntType(64)
NUMBERS, WORDS = ir.VectorType(DOUBLE, LANES), ir.VectorType(WORD, LANES)
MARKS, PLACE = ir.IntType(8), ir.IntType(32)


@cache
def same(value: float) -> Any:
    """Return one number in every lane; the same object each time, which knows how it is written."""
    return ir.Constant(NUMBERS, [value] * LANES)


class Lanes:
    """Builder of vectors, as `solver.kernels.record.operations` uses it."""

    def __init__(self, builder) -> None:
        self.builder = builder
        self.same = same

    def word(self, value):
        """Return one whole number of 64 bits in every lane."""
        return ir.Constant(WORDS, [value] * LANES)

    def greater(self, x, y):
        """Return where x > y."""
        return self.builder.fcmp_ordered(">", x, y)

    def bits(self, x):
        """Return the bits of numbers as words."""
        return self.builder.bitcast(x, WORDS)

    def numbers(self, words):
        """Return the numbers of these bits."""
        return self.builder.bitcast(words, NUMBERS)

    def whole(self, x):
        """Return whole numbers as words."""
        return self.builder.fptosi(x, WORDS)

    def call(self, name, x):
        """Return a function of the processor's own: no call is left of it."""
        kind = ir.FunctionType(NUMBERS, [NUMBERS])
        there = f"llvm.{name}.v{LANES}f64"
        function = cgutils.get_or_insert_function(self.builder.module, kind, there)
        return self.builder.call(function, [x])


def positive(builder, x):
    """Return bit k for each lane k whose number is positive."""
    bits = builder.bitcast(Lanes(builder).greater(x, same(0.0)), ir.IntType(LANES))
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
        x = builder.select(Lanes(builder).greater(x, other), x, other)
        width //= 2
    return builder.extract_element(x, PLACE(0))


def _places(lanes: list[int]) -> Any:
    return ir.Constant(ir.VectorType(PLACE, LANES), lanes)
