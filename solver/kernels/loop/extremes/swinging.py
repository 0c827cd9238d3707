"""Channels of a step at eight instants: by how much they leave their ends' values, eight at once.

A channel at a time, this took longer than all else that extremes take in a step that swings.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from functools import reduce
from itertools import pairwise
from typing import cast

from numba import float64, int64, types
from numba.core import cgutils
from numba.extending import intrinsic

from jointplay.solver.kernels.emit.scanning import UNSEEN
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.eights import (
    WORD,
    Eight,
    arrays,
    channels,
    column,
    first,
    larger,
    same,
    smaller,
    where,
)
from jointplay.solver.kernels.loop.extremes.search.brackets import TINY

ROUGH = 0.003
"""Share of a channel's range by which it leaves its values at the ends of a rough step."""
SEEN = 1e-6
"""The same, from which on a swing is worth a search."""
REACH = 4.0
"""Times that a swing may be larger between the instants, or in the next steps that are not looked
at: one that swings more is. A swing that is not worth a search may grow until it is."""
MUCH = SEEN / REACH
"""Share of its range that stands for a swing which is worth a search: it may grow by `REACH`."""
ALTERNATING = 0.125
"""Share of a channel's second difference from step to step by which every other step may swing,
where the channel turned between them. At the limit of stability steps alternate: friction may
reverse inside those in which a channel rises, and the others do not show it."""
BARELY = 1.0 + 1e-9
"""A factor that is more than all rounding here."""
UNKNOWN = 1e300
"""Stands for the bend of a channel where there is no step before."""
NEARBY, UNEVEN, UNSEEN_AT_ENDS = 0xFF, 0xFF00, 0xFF0000
"""Bits of an answer for a channel of each eight: an extreme is in reach; is rough; swings by more
than the ends of two steps change, which do not show it at all."""
FOUND = types.Tuple((int64, float64, float64))


def _weigh(_typing, values, channel, work, extremes, lane, longer, pause):
    """Return what the channels of a step come to.

    Parameters
    ----------
    values : (slots, INSTANTS)
        At even instants, from the slot `channel` on.
    work : (slots, lanes)
        Has the lane's extremes so far.
    extremes
        Slots of the first highest and lowest value, range that is rounding, and change in the step
        before; number of channels.
    longer
        Length of this step by that of the step before.
    pause
        Steps.

    Returns
    -------
    Bits of `NEARBY`, `UNEVEN`, `UNSEEN_AT_ENDS`. In how many steps a swing may come to an extreme,
    if less than the pause. The largest share of its range by which a channel swings, `MUCH` for
    what is worth a search. Channels whose range is rounding are left out.
    """

    def generate(context, builder, signature, arguments):
        spare, lanes = arrays(context, builder, signature, arguments)
        width = builder.extract_value(lanes.shape, 1)
        *slots, count = cgutils.unpack_tuple(builder, arguments[3], 5)
        found, longer = _Found(builder, arguments[6]), same(builder, arguments[5])
        groups = builder.udiv(builder.add(count, WORD(INSTANTS - 1)), WORD(INSTANTS))
        with cgutils.for_range(builder, groups) as loop:
            before = builder.mul(loop.index, WORD(INSTANTS))
            values = channels(builder, spare.data, builder.add(arguments[1], before))
            rows = (builder.mul(builder.add(slot, before), width) for slot in slots)
            highest, lowest, least, change = (
                column(builder, lanes.data, builder.add(row, arguments[4]), width) for row in rows
            )
            kept = first(builder, builder.sub(count, before)) & (least < highest - lowest)
            _add(found, values, highest, lowest, longer * change, kept)
        return context.make_tuple(builder, FOUND, found.numbers())

    return FOUND(values, channel, work, extremes, lane, longer, pause), generate


weigh_swings = cast(Callable[..., tuple[int, float, float]], intrinsic(_weigh))


def _add(found, values, highest, lowest, change, kept):
    """Let eight channels count, but for those that are not kept.

    `change` : from end to end of the step before, had that been as long.
    """
    start, *inner, end = values
    low, high = smaller(start, end), larger(start, end)
    above, below = reduce(larger, inner, high) - high, low - reduce(smaller, inner, low)
    spread, swing = highest - lowest, larger(above, below)
    seen = SEEN * spread
    upwards = (seen < above) & (highest < high + REACH * above)
    downwards = (seen < below) & (low - REACH * below < lowest)
    found.mark(NEARBY, kept & (upwards | downwards))
    found.mark(UNEVEN, kept & (ROUGH * spread < swing))
    found.mark(UNSEEN_AT_ENDS, kept & (seen < swing) & (abs(end - start) + abs(change) < swing))
    found.swing(where(seen < swing, MUCH * spread, swing), spread, kept)
    rest = smaller(highest - high, low - lowest)
    bend = smaller(abs(end - start - change), UNKNOWN) + TINY
    inside = _hidden(values)
    hidden = where(UNSEEN * spread < inside, inside, 0.0)
    by = where(seen < swing, swing, hidden)
    found.wait(_Approach(abs(end - start), bend, rest, REACH * by), kept & (by > 0.0))
    # steps that alternate come closer by their drift, which may grow by as much in each
    turned, drift = (end - start) * change < 0.0, 0.5 * abs(end - start + change)
    every_other = _Approach(drift, drift + TINY, rest, REACH * ALTERNATING * bend)
    found.wait(every_other, kept & turned)


def _hidden(values):
    """Return by how much channels swing about the way from end to end, if as quartics do.

    Of channels that rise by more in the step than they swing, nothing else shows it. A quartic that
    is flat at both ends has a height of 1/16, and fourth differences of 24 / 7^4. What swings less
    than `UNSEEN` is sought where it turns, by the scan.
    """
    differences = values
    for _ in range(4):
        differences = [after - one for one, after in pairwise(differences)]
    return (INSTANTS - 1) ** 4 / (24 * 16) * reduce(larger, map(abs, differences))


class _Approach:
    """In how many steps a swing may come to an extreme that now is farther by the `rest`.

    Ends of steps must come as close to it, and turn: while they change by more than that from one
    step to the next, the next one is beyond all that is in this. They are taken to change and bend
    twice as much as now. What bends inside the step is mostly the swing, and tells nothing of ends.
    """

    def __init__(self, speed, bend, rest, swing) -> None:
        """`speed`, `bend` : sizes of a change and a second difference from step to step."""
        self._speed, self._bend = speed, bend
        self._close, self._beyond = larger(rest - swing, 0.0), speed - swing

    def steps(self) -> Eight:
        """Return that."""
        way = self._speed + (self._bend * self._close).sqrt() + TINY
        return 0.5 * larger(self._close / way, self._beyond / self._bend)

    def may_end(self, pause) -> Eight:
        """Return where it may be fewer than a pause, without divisions and roots."""
        twice = 2.0 * BARELY * pause
        bends, left = twice * self._bend, self._close - twice * self._speed
        late = (left > 0.0) & (twice * bends * self._close < left * left)
        return ~(late | (bends < self._beyond))


class _Found:
    """Numbers that channels have come to so far."""

    def __init__(self, builder, pause) -> None:
        self._builder = builder
        self._answer = cgutils.alloca_once_value(builder, WORD(0))
        self._pause = cgutils.alloca_once_value(builder, pause)
        self._largest = cgutils.alloca_once_value(builder, Eight(builder, 0.0).value)

    def mark(self, bits, marks) -> None:
        """Set one of the bits for each mark."""
        b, shift = self._builder, WORD((bits & -bits).bit_length() - 1)
        b.store(b.or_(b.load(self._answer), b.shl(marks.bits(), shift)), self._answer)

    def swing(self, by, spread, kept) -> None:
        """Note a swing of those that are kept, if its share of the spread is the largest."""
        b = self._builder
        with self._any(kept & (self._shares() * spread < by)):
            b.store(larger(self._shares(), where(kept, by / spread, 0.0)).value, self._largest)

    def wait(self, approach, kept) -> None:
        """Note in how many steps those that are kept may come to an extreme."""
        b = self._builder
        sooner = kept & approach.may_end(same(b, b.load(self._pause)))
        with self._any(sooner):
            steps = where(sooner, approach.steps(), float("inf")).one(smaller)
            before = b.load(self._pause)
            b.store(b.select(b.fcmp_ordered("<", steps, before), steps, before), self._pause)

    def numbers(self):
        """Return all."""
        b = self._builder
        return [b.load(self._answer), b.load(self._pause), self._shares().one(larger)]

    def _shares(self) -> Eight:
        return Eight(self._builder, self._builder.load(self._largest))

    def _any(self, marks):
        return self._builder.if_then(self._builder.icmp_unsigned("!=", marks.bits(), WORD(0)))
