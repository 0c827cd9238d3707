"""Channels of a step at eight instants: by how much they leave their ends' values, eight at once.

A channel at a time, this took longer than all else that extremes take in a step that swings.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from typing import Any, cast

from numba import float64, int64, types
from numba.core import cgutils
from numba.extending import intrinsic

from jointplay.solver.kernels.emit.scanning import BARELY
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.eights import WORD, Eights

ROUGH = 0.003
"""Share of a channel's range by which it leaves its values at the ends of a rough step."""
SEEN = 1e-6
"""The same, from which on a swing is worth a search."""
REACH = 4.0
"""Times that a swing may be larger between the instants, or in the next steps that are not looked
at: one that swings more is. A swing that is not worth a search may grow until it is."""
MUCH = SEEN / REACH
"""Share of its range that stands for a swing which is worth a search: it may grow by `REACH`."""
TINY, UNKNOWN = 1e-300, 1e300
"""The least bend of a channel, and what stands for that where there is no step before."""
NEARBY, UNEVEN = 0xFF, 0xFF00
"""Bits of an answer for a channel of each eight: an extreme is in reach; is rough."""
FOUND = types.Tuple((int64, float64, float64))


def _weigh(
    _typing: Any,
    values: Any,
    channel: Any,
    work: Any,
    extremes: Any,
    lane: Any,
    longer: Any,
    pause: Any,
) -> Any:
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
    Bits of `NEARBY`, `UNEVEN`. In how many steps a swing may come to an extreme, if less than the
    pause. The largest share of its range by which a channel swings, `MUCH` for what is worth a
    search. Channels whose range is rounding are left out.
    """

    def generate(context, builder, signature, arguments):
        spare, lanes = (
            context.make_array(signature.args[k])(context, builder, value=arguments[k])
            for k in (0, 2)
        )
        at = _Channels(builder, spare.data, lanes, arguments[4])
        *slots, count = cgutils.unpack_tuple(builder, arguments[3], 5)
        found, longer = _Found(at, arguments[6]), at.same(arguments[5])
        groups = builder.udiv(builder.add(count, WORD(INSTANTS - 1)), WORD(INSTANTS))
        with cgutils.for_range(builder, groups) as loop:
            first = builder.mul(loop.index, WORD(INSTANTS))
            v = at.channels(at.spare, builder.add(arguments[1], first))
            highest, lowest, least, change = (
                at.of_lane(builder.add(slot, first)) for slot in slots
            )
            moves = at.less(least, builder.fsub(highest, lowest))
            kept = builder.and_(at.first(builder.sub(count, first)), moves)
            _add(found, at, v, highest, lowest, builder.fmul(longer, change), kept)
        return context.make_tuple(builder, FOUND, found.numbers())

    return FOUND(values, channel, work, extremes, lane, longer, pause), generate


weigh_swings = cast(Callable[..., tuple[int, float, float]], intrinsic(_weigh))


def _add(found, at, v, highest, lowest, change, kept):
    """Let eight channels count, but for those that are not kept.

    `change` : from end to end of the step before, had that been as long.
    """
    b, last = at.builder, INSTANTS - 1
    spread = b.fsub(highest, lowest)
    low, high = at.smaller(v[0], v[last]), at.larger(v[0], v[last])
    bottom, top = low, high
    for i in range(1, last):
        bottom, top = at.smaller(bottom, v[i]), at.larger(top, v[i])
    above, below = b.fsub(top, high), b.fsub(low, bottom)
    swing, seen = at.larger(above, below), at.times(SEEN, spread)
    upwards = b.and_(at.less(seen, above), at.less(highest, b.fadd(high, at.times(REACH, above))))
    downwards = b.and_(at.less(seen, below), at.less(b.fsub(low, at.times(REACH, below)), lowest))
    found.mark(NEARBY, b.and_(kept, b.or_(upwards, downwards)))
    found.mark(UNEVEN, b.and_(kept, at.less(at.times(ROUGH, spread), swing)))
    counted = b.select(at.less(seen, swing), at.times(MUCH, spread), swing)
    more = b.and_(kept, at.less(b.fmul(found.largest.now(), spread), counted))
    with b.if_then(b.icmp_unsigned("!=", at.bits(more), WORD(0))):
        found.largest.let(at.larger, b.select(kept, b.fdiv(counted, spread), at.number(0.0)))
    rise = b.fsub(v[last], v[0])
    bend = at.smaller(at.size(b.fsub(rise, change)), at.number(UNKNOWN))
    approach = _Approach(
        at,
        at.size(rise),
        b.fadd(bend, at.number(TINY)),
        at.smaller(b.fsub(highest, high), b.fsub(low, lowest)),
        at.times(REACH, swing),
    )
    sooner = b.and_(b.and_(kept, at.less(seen, swing)), approach.may_end(b.load(found.pause)))
    with b.if_then(b.icmp_unsigned("!=", at.bits(sooner), WORD(0))):
        steps = at.least(b.select(sooner, approach.steps(), at.number(float("inf"))))
        before = b.load(found.pause)
        b.store(b.select(b.fcmp_ordered("<", steps, before), steps, before), found.pause)


class _Approach:
    """In how many steps a swing may come to an extreme that now is farther by the `rest`.

    Ends of steps must come as close to it, and turn: while they change by more than that from one
    step to the next, the next one is beyond all that is in this. They are taken to change and bend
    twice as much as now. What bends inside the step is mostly the swing, and tells nothing of ends.
    """

    def __init__(self, at, speed, bend, rest, swing) -> None:
        """`speed`, `bend` : sizes of a change and a second difference from step to step."""
        self._at, self._speed, self._bend = at, speed, bend
        self._close = at.larger(at.builder.fsub(rest, swing), at.number(0.0))
        self._beyond = at.builder.fsub(speed, swing)

    def steps(self):
        """Return that."""
        at, b = self._at, self._at.builder
        root = at.root(b.fmul(self._bend, self._close))
        way = b.fadd(b.fadd(self._speed, root), at.number(TINY))
        later = at.larger(b.fdiv(self._close, way), b.fdiv(self._beyond, self._bend))
        return at.times(0.5, later)

    def may_end(self, pause):
        """Return where it may be fewer than a pause, without divisions and roots."""
        at, b = self._at, self._at.builder
        twice = at.times(2.0 * BARELY, at.same(pause))
        bends = b.fmul(twice, self._bend)
        left = b.fsub(self._close, b.fmul(twice, self._speed))
        far = at.less(b.fmul(b.fmul(twice, bends), self._close), b.fmul(left, left))
        late = b.and_(at.less(at.number(0.0), left), far)
        return b.not_(b.or_(late, at.less(bends, self._beyond)))


class _Found:
    """Numbers that channels have come to so far."""

    def __init__(self, at, pause) -> None:
        self._at, b = at, at.builder
        self.answer = cgutils.alloca_once_value(b, WORD(0))
        self.pause = cgutils.alloca_once_value(b, pause)
        self.largest = _Vector(at, 0.0)

    def mark(self, bits, marks) -> None:
        """Set one of the bits for each mark."""
        b = self._at.builder
        shift = WORD((bits & -bits).bit_length() - 1)
        found = b.or_(b.load(self.answer), b.shl(self._at.bits(marks), shift))
        b.store(found, self.answer)

    def numbers(self):
        """Return all."""
        b, largest = self._at.builder, self._at.largest(self.largest.now())
        return [b.load(self.answer), b.load(self.pause), largest]


class _Vector:
    """Eight numbers that change."""

    def __init__(self, at, value) -> None:
        self._builder = at.builder
        self._place = cgutils.alloca_once_value(at.builder, at.number(value))

    def now(self):
        return self._builder.load(self._place)

    def let(self, combine, others) -> None:
        self._builder.store(combine(self.now(), others), self._place)


class _Channels(Eights):
    """Channels of a step, and extremes so far of its lane."""

    def __init__(self, builder, spare, lanes, lane) -> None:
        super().__init__(builder)
        self.spare, self._data, self._lane = spare, lanes.data, lane
        self._lanes = builder.extract_value(lanes.shape, 1)

    def of_lane(self, slot):
        """Return the lane's numbers in eight slots."""
        first = self.builder.add(self.builder.mul(slot, self._lanes), self._lane)
        return self.column(self._data, first, self._lanes)
