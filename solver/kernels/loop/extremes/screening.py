"""Eight channels at eight instants each: which may be beyond their extremes in between."""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from typing import Any, cast

from numba import int64
from numba.extending import intrinsic

from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.book import (
    HIGHEST,
    HIGHEST_TIME,
    LOWEST,
    LOWEST_TIME,
    RANGE,
    ROUNDING,
)
from jointplay.solver.kernels.loop.extremes.eights import WORD, Eights
from jointplay.solver.kernels.loop.extremes.seeking import SHARP
from jointplay.solver.kernels.loop.extremes.tops import CORNER

ULPS = 1e-15
"""Share of a value that is its own rounding."""
ONE_BY_ONE = 8
"""Bits of an answer for the channels, whose values are to be counted one by one."""
JAGGED = 16
"""Bits of an answer for the channels which turn at every instant, if that is no rounding."""


def _screen(
    _typing: Any, values: Any, row: Any, book: Any, first: Any, begin: Any, end: Any, sharp: Any
) -> Any:
    """Let the ends of a part of a step count, and return which channels may be beyond inside.

    Parameters
    ----------
    values : (slots, INSTANTS)
        At even instants.
    row
        Slot of the first of eight channels.
    book : (rows, channels)
        See `solver.kernels.loop.extremes.book`.
    first
        Column of the first of the eight channels there.
    begin, end
        Times of the first and the last instant, s.
    sharp
        Share of its range by which an extreme may be off unseen.

    Bit k of the answer stands for channel k: its extremes may be inside. Bits from `ONE_BY_ONE`
    on: it moves by no more than its rounding, and is beyond the extreme so far. From `JAGGED`
    on: it turns at every instant.
    """

    def generate(context, builder, signature, arguments):
        arrays = [
            context.make_array(signature.args[k])(context, builder, value=arguments[k])
            for k in (0, 2)
        ]
        width = builder.extract_value(arrays[1].shape, 1)
        vectors = _Book(builder, arrays[0].data, arrays[1].data, width, arguments[3])
        return _answer(vectors, arguments[1], *arguments[4:])

    return int64(values, row, book, first, begin, end, sharp), generate


screen = cast(Callable[..., int], intrinsic(_screen))


def _answer(at, row, begin, end, sharp):
    """Generate the code of `screen`."""
    b, v = at.builder, at.of(row)
    last = INSTANTS - 1
    low, high = at.line(LOWEST), at.line(HIGHEST)
    low_time, high_time = at.line(LOWEST_TIME), at.line(HIGHEST_TIME)
    for value, time in ((v[0], at.same(begin)), (v[last], at.same(end))):
        below, above = at.less(value, low), at.less(high, value)
        low, low_time = b.select(below, value, low), b.select(below, time, low_time)
        high, high_time = b.select(above, value, high), b.select(above, time, high_time)
    for line, found in (
        (LOWEST, low),
        (HIGHEST, high),
        (LOWEST_TIME, low_time),
        (HIGHEST_TIME, high_time),
    ):
        at.write(line, found)
    least, most, bend = v[1], v[1], None
    for i in range(1, last):
        least, most = at.smaller(least, v[i]), at.larger(most, v[i])
        bent = at.size(b.fsub(b.fadd(v[i - 1], v[i + 1]), b.fadd(v[i], v[i])))
        bend = bent if bend is None else at.larger(bend, bent)
    far = b.fsub(
        at.larger(most, at.larger(v[0], v[last])), at.smaller(least, at.smaller(v[0], v[last]))
    )
    own = b.fmul(at.number(ULPS), at.larger(at.size(v[0]), at.size(v[last])))
    moves = at.less(at.larger(at.line(ROUNDING), own), far)
    spread = at.line(RANGE)
    beyond = b.fsub(b.fmul(at.number(CORNER), bend), b.fmul(at.same(sharp), spread))
    inside = b.or_(at.less(high, b.fadd(most, beyond)), at.less(b.fsub(least, beyond), low))
    wide = at.larger(spread, b.fsub(high, low))
    hidden = _hides_beside_ends(at, v, low, high, b.fmul(at.number(SHARP), wide))
    wanted = b.and_(moves, b.or_(inside, hidden))
    surpassed = b.or_(at.less(high, most), at.less(least, low))
    one_by_one = b.and_(b.not_(moves), surpassed)
    jagged = b.and_(wanted, at.less(far, bend))
    answer = at.bits(wanted)
    for marks, shift in ((one_by_one, ONE_BY_ONE), (jagged, JAGGED)):
        answer = b.or_(answer, b.shl(at.bits(marks), WORD(shift)))
    return answer


def _hides_beside_ends(at, v, low, high, sharp):
    """Return where beside an end an extreme may hide, beyond the one so far by more than `sharp`.

    A corner shows in the seventh difference of eight values by no less than it goes beyond them.
    Without one, a channel goes on from its end where it bends by less than it rises, or than is
    worth a look; otherwise it goes beyond by a part of what it bends.

    The end of the step before is the same instant, but may differ in the last bit.
    """
    b, seventh = at.builder, at.number(0.0)
    for i, weight in enumerate((-1.0, 7.0, -21.0, 35.0)):
        apart = b.fsub(v[i], v[INSTANTS - 1 - i])
        seventh = b.fadd(seventh, b.fmul(at.number(weight), apart))
    seventh = at.size(seventh)
    cornered = b.not_(b.fcmp_ordered("<=", seventh, sharp))
    found = None
    for end, sense in ((0, 1), (INSTANTS - 1, -1)):
        rise = b.fsub(v[end + sense], v[end])
        bend = at.size(b.fsub(b.fsub(v[end + 2 * sense], v[end + sense]), rise))
        turns = b.and_(at.less(sharp, bend), b.not_(at.less(bend, at.size(rise))))
        reach = b.select(cornered, seventh, at.larger(sharp, b.fmul(at.number(CORNER), bend)))
        below = b.fcmp_ordered("<=", b.fsub(v[end], reach), low)
        beyond = b.or_(below, b.fcmp_ordered(">=", b.fadd(v[end], reach), high))
        hides = b.and_(beyond, b.or_(cornered, turns))
        found = hides if found is None else b.or_(found, hides)
    return found


class _Book(Eights):
    """Channels, and their lines in a book."""

    def __init__(self, builder, values, book, width, first) -> None:
        super().__init__(builder)
        self._values, self._book, self._width, self._first = values, book, width, first

    def of(self, row):
        """Return eight channels at each of eight instants."""
        return self.channels(self._values, row)

    def line(self, line):
        return self.load(self._book, self._place(line))

    def write(self, line, vector) -> None:
        self.store(self._book, self._place(line), vector)

    def _place(self, line):
        return self.builder.add(self.builder.mul(self._width, WORD(line)), self._first)
