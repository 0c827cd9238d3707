"""Eight channels at eight instants each: which may be beyond their extremes in between."""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from functools import reduce
from operator import add, or_
from typing import cast

from numba import int64
from numba.extending import intrinsic

from jointplay.records.peak import HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.eights import (
    WORD,
    Eight,
    arrays,
    channels,
    larger,
    load,
    same,
    smaller,
    store,
    where,
)
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.kernels.loop.extremes.search.local_extremes import CORNER
from jointplay.solver.kernels.loop.extremes.window.blank_book import RANGE, ROUNDING
from jointplay.solver.kernels.loop.extremes.window.polynomial_extreme import SEVENTH

ULPS = 1e-15
"""Share of a value that is its own rounding."""
ONE_BY_ONE = 8
"""Bits of an answer for the channels, whose values are to be counted one by one."""
JAGGED = 16
"""Bits of an answer for the channels which turn at every instant, if that is no rounding."""


def _screen(_typing, values, row, book, first, begin, end, sharp):
    """Let the ends of a part of a step count, and return which channels may be beyond inside.

    Parameters
    ----------
    values : (slots, INSTANTS)
        At even instants.
    row
        Slot of the first of eight channels.
    book : (rows, channels)
        See `solver.kernels.loop.extremes.window.blank_book`.
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
        spare, lines = arrays(context, builder, signature, arguments)
        width = builder.extract_value(lines.shape, 1)
        own = _Book(builder, lines.data, width, arguments[3])
        times = [same(builder, time) for time in arguments[4:6]]
        least = same(builder, arguments[6])
        return _answer(channels(builder, spare.data, arguments[1]), own, times, least)

    return int64(values, row, book, first, begin, end, sharp), generate


screen = cast(Callable[..., int], intrinsic(_screen))


def _answer(v, book, times, sharp):
    """Generate the code of `screen`, of channels at eight instants."""
    start, *inner, end = v
    low, high = book[LOWEST], book[HIGHEST]
    low_time, high_time = book[LOWEST_TIME], book[HIGHEST_TIME]
    for value, time in zip((start, end), times, strict=True):
        below, above = value < low, high < value
        low, low_time = where(below, value, low), where(below, time, low_time)
        high, high_time = where(above, value, high), where(above, time, high_time)
    book[LOWEST], book[LOWEST_TIME] = low, low_time
    book[HIGHEST], book[HIGHEST_TIME] = high, high_time
    least, most = reduce(smaller, inner), reduce(larger, inner)
    bends = [abs(v[i - 1] + v[i + 1] - (v[i] + v[i])) for i in range(1, INSTANTS - 1)]
    bend, spread = reduce(larger, bends), book[RANGE]
    far = larger(most, larger(start, end)) - smaller(least, smaller(start, end))
    moves = larger(book[ROUNDING], ULPS * larger(abs(start), abs(end))) < far
    beyond = CORNER * bend - sharp * spread
    inside = (high < most + beyond) | (least - beyond < low)
    hidden = _hides_beside_ends(v, low, high, SHARP * larger(spread, high - low))
    wanted = moves & (inside | hidden)
    one_by_one = ~moves & ((high < most) | (least < low))
    answer, b = wanted.bits(), wanted.builder
    for marks, shift in ((one_by_one, ONE_BY_ONE), (wanted & (far < bend), JAGGED)):
        answer = b.or_(answer, b.shl(marks.bits(), WORD(shift)))
    return answer


def _hides_beside_ends(v, low, high, sharp) -> Eight:
    """Return where beside an end an extreme may hide, beyond the one so far by more than `sharp`.

    A corner shows in the seventh difference of eight values by no less than it goes beyond them.
    Without one, a channel goes on from its end where it bends by less than it rises, or than is
    worth a look; otherwise it goes beyond by a part of what it bends.

    The end of the step before is the same instant, but may differ in the last bit.
    """
    seventh = abs(reduce(add, (w * (x - y) for w, x, y in zip(SEVENTH, v, v[::-1], strict=False))))
    cornered = ~(seventh <= sharp)
    hides = []
    for end, beside, next_one in (v[:3], v[:-4:-1]):
        rise = beside - end
        bend = abs(next_one - beside - rise)
        turns = (sharp < bend) & ~(bend < abs(rise))
        reach = where(cornered, seventh, larger(sharp, CORNER * bend))
        beyond = (end - reach <= low) | (end + reach >= high)
        hides.append(beyond & (cornered | turns))
    return reduce(or_, hides)


class _Book:
    """Lines of a book, of eight channels."""

    def __init__(self, builder, values, width, first) -> None:
        self._builder, self._values, self._width, self._first = builder, values, width, first

    def __getitem__(self, line) -> Eight:
        return load(self._builder, self._values, self._place(line))

    def __setitem__(self, line, numbers) -> None:
        store(self._builder, self._values, self._place(line), numbers)

    def _place(self, line):
        return self._builder.add(self._builder.mul(self._width, WORD(line)), self._first)
