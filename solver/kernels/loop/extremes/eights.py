"""Eight numbers at a time, mostly of as many channels: arithmetic that Numba makes none of.

A channel at a time, looks at channels took longer than computing the channels did.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from __future__ import annotations

from llvmlite import ir
from numba.core import cgutils, types

from jointplay.solver.kernels.emit.lane_arithmetic import ALIGNED
from jointplay.solver.kernels.layout import INSTANTS

NUMBER, WORD, INDEX = ir.DoubleType(), ir.IntType(64), ir.IntType(32)
EIGHT, WORDS = ir.VectorType(NUMBER, INSTANTS), ir.VectorType(WORD, INSTANTS)


def _instruction(name):
    """Return a method that writes one on numbers or marks."""

    def method(self, other) -> Eight:
        return Eight(self.builder, getattr(self.builder, name)(self.value, self.lifted(other)))

    return method


def _comparison(sign):
    """Return a method that writes one: marks are nowhere where one of both is no number."""

    def method(self, other) -> Eight:
        compared = self.builder.fcmp_ordered(sign, self.value, self.lifted(other))
        return Eight(self.builder, compared)

    return method


class Eight:
    """Eight numbers, or marks of what is true of them, in code that is written.

    Arithmetic on them writes more of it. A plain number is the same eight times.
    """

    def __init__(self, builder, value) -> None:
        self.builder = builder
        self.value = ir.Constant(EIGHT, [value] * INSTANTS) if isinstance(value, float) else value

    __add__, __sub__ = _instruction("fadd"), _instruction("fsub")
    __mul__ = __rmul__ = _instruction("fmul")
    __truediv__ = _instruction("fdiv")
    __and__, __or__ = _instruction("and_"), _instruction("or_")
    __lt__, __gt__ = _comparison("<"), _comparison(">")
    __le__, __ge__ = _comparison("<="), _comparison(">=")

    def lifted(self, other):
        """Return the value of an operand beside this."""
        return other.value if isinstance(other, Eight) else Eight(self.builder, other).value

    def __invert__(self) -> Eight:
        return Eight(self.builder, self.builder.not_(self.value))

    def __abs__(self) -> Eight:
        b = self.builder
        unsigned = ir.Constant(WORDS, [2**63 - 1] * INSTANTS)
        return Eight(b, b.bitcast(b.and_(b.bitcast(self.value, WORDS), unsigned), EIGHT))

    def sqrt(self) -> Eight:
        """Return the square roots."""
        kind, name = ir.FunctionType(EIGHT, [EIGHT]), f"llvm.sqrt.v{INSTANTS}f64"
        root = cgutils.get_or_insert_function(self.builder.module, kind, name)
        return Eight(self.builder, self.builder.call(root, [self.value]))

    def bits(self):
        """Return a word in which bit k is set where mark k is."""
        return self.builder.zext(self.builder.bitcast(self.value, ir.IntType(INSTANTS)), WORD)

    def one(self, combine):
        """Return what `larger` or `smaller` leaves of the eight."""
        found = self
        for half in (4, 2, 1):
            order = _order([k ^ half for k in range(INSTANTS)])
            swapped = self.builder.shuffle_vector(found.value, found.value, order)
            found = combine(found, Eight(self.builder, swapped))
        return self.builder.extract_element(found.value, INDEX(0))


def where(marks, x, y) -> Eight:
    """Return x where a mark is set, else y."""
    chosen = marks.builder.select(marks.value, marks.lifted(x), marks.lifted(y))
    return Eight(marks.builder, chosen)


def smaller(x, y) -> Eight:
    """Return the smaller of each two; y where one is no number."""
    return where(x < y, x, y)


def larger(x, y) -> Eight:
    """Return the larger of each two; y where one is no number."""
    return where(y < x, x, y)


def arrays(context, builder, signature, arguments):
    """Return the arrays among the arguments of an intrinsic function."""
    given = zip(signature.args, arguments, strict=True)
    return [
        context.make_array(kind)(context, builder, value=value)
        for kind, value in given
        if isinstance(kind, types.Array)
    ]


def channels(builder, values, row) -> list[Eight]:
    """Return eight channels, from a slot on, at each of eight instants: (slots, INSTANTS)."""
    slots = (builder.add(row, WORD(k)) for k in range(INSTANTS))
    rows = [load(builder, values, builder.mul(slot, WORD(INSTANTS))).value for slot in slots]
    return [Eight(builder, one) for one in _transposed(builder, rows)]


def column(builder, values, first, width) -> Eight:
    """Return eight numbers, `width` apart."""
    found = ir.Constant(EIGHT, ir.Undefined)
    for k in range(INSTANTS):
        address = builder.gep(values, [builder.add(first, builder.mul(width, WORD(k)))])
        found = builder.insert_element(found, builder.load(address, align=ALIGNED), INDEX(k))
    return Eight(builder, found)


def load(builder, values, offset) -> Eight:
    """Return eight numbers side by side."""
    return Eight(builder, builder.load(_pointer(builder, values, offset), align=ALIGNED))


def store(builder, values, offset, numbers) -> None:
    """Write eight numbers side by side."""
    builder.store(numbers.value, _pointer(builder, values, offset), align=ALIGNED)


def same(builder, number) -> Eight:
    """Return a number eight times."""
    return Eight(builder, _everywhere(builder, EIGHT, number))


def first(builder, count) -> Eight:
    """Return marks of the first ones, so many."""
    columns = ir.Constant(WORDS, list(range(INSTANTS)))
    return Eight(builder, builder.icmp_signed("<", columns, _everywhere(builder, WORDS, count)))


def _everywhere(builder, kind, one):
    undefined = ir.Constant(kind, ir.Undefined)
    alone = builder.insert_element(undefined, one, INDEX(0))
    return builder.shuffle_vector(alone, undefined, _order([0] * INSTANTS))


def _pointer(builder, values, offset):
    return builder.bitcast(builder.gep(values, [offset]), EIGHT.as_pointer())


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


def _order(order):
    return ir.Constant(ir.VectorType(INDEX, len(order)), order)
