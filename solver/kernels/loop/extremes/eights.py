"""Eight numbers at a time, mostly of as many channels: arithmetic that Numba makes none of.

A channel at a time, looks at channels took longer than computing the channels did.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from typing import Any

from llvmlite import ir
from numba.core import cgutils

from jointplay.solver.kernels.layout import INSTANTS

NUMBER, WORD, INDEX = ir.DoubleType(), ir.IntType(64), ir.IntType(32)
EIGHT = ir.VectorType(NUMBER, INSTANTS)
ALIGNED = 8


class Eights:
    """Writes code on vectors of eight."""

    def __init__(self, builder) -> None:
        self.builder = builder

    def channels(self, values, row):
        """Return eight channels, from a slot on, at each of eight instants: (slots, INSTANTS)."""
        rows = (self.builder.add(row, WORD(k)) for k in range(INSTANTS))
        offsets = (self.builder.mul(one, WORD(INSTANTS)) for one in rows)
        return _transposed(self.builder, [self.load(values, offset) for offset in offsets])

    def column(self, values, first, width):
        """Return eight numbers, `width` apart."""
        b, found = self.builder, ir.Constant(EIGHT, ir.Undefined)
        for k in range(INSTANTS):
            address = b.gep(values, [b.add(first, b.mul(width, WORD(k)))])
            found = b.insert_element(found, b.load(address, align=ALIGNED), INDEX(k))
        return found

    def load(self, values, offset):
        """Return eight numbers side by side."""
        return self.builder.load(self._pointer(values, offset), align=ALIGNED)

    def store(self, values, offset, vector) -> None:
        """Write eight numbers side by side."""
        self.builder.store(vector, self._pointer(values, offset), align=ALIGNED)

    def same(self, number):
        """Return a number eight times."""
        return self._everywhere(EIGHT, number)

    def number(self, value):
        """Return a constant eight times."""
        return ir.Constant(EIGHT, [value] * INSTANTS)

    def times(self, value, x):
        """Return the product with a number."""
        return self.builder.fmul(self.number(value), x)

    def first(self, count):
        """Return where the first numbers are, so many."""
        words = ir.VectorType(WORD, INSTANTS)
        columns = ir.Constant(words, list(range(INSTANTS)))
        return self.builder.icmp_signed("<", columns, self._everywhere(words, count))

    def largest(self, x):
        """Return the largest of eight numbers."""
        return self._one(self.larger, x)

    def least(self, x):
        """Return the smallest of eight numbers."""
        return self._one(self.smaller, x)

    def root(self, x):
        """Return the square roots."""
        kind = ir.FunctionType(EIGHT, [EIGHT])
        name = f"llvm.sqrt.v{INSTANTS}f64"
        root = cgutils.get_or_insert_function(self.builder.module, kind, name)
        return self.builder.call(root, [x])

    def less(self, x, y):
        """Return where x < y; nowhere where one is no number."""
        return self.builder.fcmp_ordered("<", x, y)

    def smaller(self, x, y):
        """Return the smaller of each two; y where one is no number."""
        return self.builder.select(self.less(x, y), x, y)

    def larger(self, x, y):
        """Return the larger of each two; y where one is no number."""
        return self.builder.select(self.less(y, x), x, y)

    def size(self, x):
        """Return x without its sign."""
        words = ir.VectorType(WORD, INSTANTS)
        kept = self.builder.and_(
            self.builder.bitcast(x, words), ir.Constant(words, [2**63 - 1] * INSTANTS)
        )
        return self.builder.bitcast(kept, EIGHT)

    def bits(self, marks):
        """Return bit k where mark k is set."""
        return self.builder.zext(self.builder.bitcast(marks, ir.IntType(INSTANTS)), WORD)

    def _everywhere(self, kind, one):
        undefined = ir.Constant(kind, ir.Undefined)
        alone = self.builder.insert_element(undefined, one, INDEX(0))
        return self.builder.shuffle_vector(alone, undefined, _order([0] * INSTANTS))

    def _one(self, combine, x):
        for half in (4, 2, 1):
            order = _order([k ^ half for k in range(INSTANTS)])
            x = combine(x, self.builder.shuffle_vector(x, x, order))
        return self.builder.extract_element(x, INDEX(0))

    def _pointer(self, values, offset):
        return self.builder.bitcast(self.builder.gep(values, [offset]), EIGHT.as_pointer())


def _transposed(builder, rows):
    """Return the columns of eight rows: pairs are exchanged across 1, 2 and 4 of them."""
    for half in (1, 2, 4):
        upper = [k for k in range(INSTANTS) if not k & half]
        lower = [INSTANTS + k - half if k & half else k for k in range(INSTANTS)]
        right = [INSTANTS + k if k & half else k + half for k in range(INSTANTS)]
        found = list(rows)
        for k in upper:
            pair = rows[k], rows[k + half]
            found[k] = builder.shuffle_vector(*pair, _order(lower))
            found[k + half] = builder.shuffle_vector(*pair, _order(right))
        rows = found
    return rows


def _order(order: list[int]) -> Any:
    return ir.Constant(ir.VectorType(INDEX, len(order)), order)
