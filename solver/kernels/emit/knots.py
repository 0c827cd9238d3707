"""Knots and steps: a step ends where a function has a derivative that jumps.

No estimate of an error holds for a step with a knot inside. Knots of a clock limit the step before
it is tried (`to_knot`). Knots of a position or a rate are met where the motion meets them: after a
step whose argument has passed one, the cubic through the argument and its rate at both ends says
after which share of the step (`knot_share`), and the step is redone to end there.
"""

from collections.abc import Sequence

from jointplay.solver.kernels.emit.emit import FixedNodes, Output, lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import numbered
from jointplay.solver.kernels.trace.knots import KnotsOnPath
from jointplay.solver.kernels.trace.tracer import Expression, Knots
from jointplay.solver.quantities.scalars import floor, maximum, minimum, select_positive, sign

FAR = 1e300
"""Time to a knot, and distance from one, where there is none."""
SAME = 1e-12
"""Share of the span of knots within which a clock is at one of them: rounding of times."""
ULPS = 4e-15
"""Share of a knot's own size that counts likewise."""
BESIDE = 4.0
"""Multiple of these: where the value jumps, one step ends so much before the knot, the next one as
much behind it."""
AT_END = 1e-4
"""Share of an argument's way in a step: a knot so close to either end of it is at that end."""
ITERATIONS = 5
"""Newton steps, kept inside a bracket, to where a cubic meets a knot."""

AT_ENDS = ("argument", "argument_rate")
"""Quantities of knots of a position or a rate, known at both ends of a step."""


class KnotTracer:
    """Records the functions that look for knots, for the equations of a scene."""

    def __init__(self, paths: Sequence[KnotsOnPath], layout: Layout) -> None:
        self.clocked = [path for path in paths if path.clocked]
        self.met = [path for path in paths if not path.clocked]
        self.layout = layout
        if self.clocked:
            layout.add("to_knot", "unhindered")
        if self.met:
            layout.add("knot_share")
        layout.add("resumed")
        for name in AT_ENDS:
            layout.add_block(name, len(self.met))
            layout.add_block(f"{name}_start", len(self.met))

    def source(self, fixed: FixedNodes) -> list[Source]:
        """Return the sources of what an attempt calls: before its stages, and before the judge."""
        return [*self._ahead(fixed), *self._passed(fixed)]

    def around(self, calls: list[str]) -> list[str]:
        """Return the calls of an attempt but for the judge, with those that look for knots."""
        ahead = ["look_from_start", "look_for_knots"] if self.clocked else []
        return [*ahead, *calls, *(["meet_knots"] if self.met else [])]

    def at_end(self) -> list[Output]:
        """Return the arguments and their rates where a step ends."""
        return numbered(AT_ENDS, [(path.knots.argument, path.rate) for path in self.met])

    def ends(self) -> list[tuple[str, str]]:
        """Return the slots of these: at the start of a step, and at its end."""
        return [
            (f"{name}_start{i}", f"{name}{i}") for name in AT_ENDS for i in range(len(self.met))
        ]

    def _ahead(self, fixed: FixedNodes) -> list[Source]:
        """Write what finds the time to the next knot of a clock."""
        if not self.clocked:
            return []
        time = self.clocked[0].rate.tracer.variable("time")
        soonest = time.tracer.constant(FAR)
        for path in self.clocked:
            soonest = _sooner(soonest, path)
        start = [("stage_time", time)]
        return [
            lane_function("look_from_start", start, self.layout),
            lane_function("look_for_knots", [("to_knot", soonest)], self.layout, fixed),
        ]

    def _passed(self, fixed: FixedNodes) -> list[Source]:
        """Write what finds the share of a step after which it meets a knot; else 2."""
        if not self.met:
            return []
        variable = self.met[0].rate.tracer.variable
        tried, first = variable("tried"), self.met[0].rate.tracer.constant(2.0)
        for i, path in enumerate(self.met):
            start, begun, end, ended = (
                variable(f"{name}{i}") for name in (*(f"{n}_start" for n in AT_ENDS), *AT_ENDS)
            )
            first = minimum(first, _share(path.knots, start, end, begun * tried, ended * tried))
        outputs = [("knot_share", first)]
        return [lane_function("meet_knots", outputs, self.layout, fixed)]


def _inside(knots: Knots, x: Expression) -> tuple[Expression, list[Expression]]:
    """Return an argument brought between the first and the last knot, and the knots around it."""
    positions = list(knots.positions)
    if knots.span is None:
        return x, positions
    inside = x - knots.span * floor((x - positions[0]) / knots.span)
    return inside, [*positions, positions[1] + knots.span, positions[-2] - knots.span]


def _sooner(soonest: Expression, path: KnotsOnPath) -> Expression:
    """Return the time to the next knot of a clock, s, where it comes sooner than another."""
    knots, rate = path.knots, path.rate
    x, positions = _inside(knots, knots.argument)
    first, last = knots.positions[0], knots.positions[-1]
    beside = SAME * (last - first) + ULPS * maximum(abs(first), abs(last))
    pace = select_positive(abs(rate), 1.0 / select_positive(abs(rate), rate, 1.0), 0.0)
    if knots.jumps:
        positions = [
            position + side * BESIDE * beside for position in positions for side in (-1.0, 1.0)
        ]
    least = beside * abs(pace)
    for position in positions:
        ahead = (position - x) * pace
        soonest = minimum(soonest, select_positive(ahead - least, ahead, FAR))
    return soonest


def _share(
    knots: Knots, start: Expression, end: Expression, begun: Expression, ended: Expression
) -> Expression:
    """Return the share of a step after which an argument meets a knot, 2 if it meets none.

    `start`, `end` : the argument; `begun`, `ended` : its rates, times the step. Where it turns
    inside the step with a knot beyond both ends, the share is where it turns.
    """
    way = end - start
    if knots.span is not None:  # an angle may begin anew
        way = way - knots.span * floor(way / knots.span + 0.5)
    x, positions = _inside(knots, start)
    sense, length = sign(way), abs(way) + 1.0 / FAR
    first, last = begun * sense / length, ended * sense / length
    turn = begun / (begun - ended + 1.0 / FAR)
    extreme = _cubic(first, last, turn) * length
    # an argument that turns goes on behind the end, or back behind the start
    reached = maximum(extreme - length, -extreme)
    middle = 0.5 * select_positive(extreme - length, extreme + length, extreme)
    half = (0.5 - AT_END) * reached
    distance, beyond = FAR, -1.0
    for position in positions:
        ahead = (position - x) * sense
        distance = minimum(distance, select_positive(ahead - AT_END * length, ahead, FAR))
        beyond = maximum(beyond, half - abs(ahead - middle))
    within = (1.0 - AT_END) * length - distance
    met = select_positive(within, _root(first, last, distance / length), 2.0)
    inside = minimum(turn - AT_END, 1.0 - AT_END - turn)
    turning = select_positive(minimum(beyond, inside), turn, 2.0)
    return minimum(met, turning)


def _cubic(first: Expression, last: Expression, theta: Expression) -> Expression:
    """Return the cubic from 0 to 1 with slopes `first` and `last` at its ends."""
    bend = 3.0 - 2.0 * first - last
    return theta * (first + theta * (bend + theta * (first + last - 2.0)))


def _root(first: Expression, last: Expression, value: Expression) -> Expression:
    """Return where that cubic has a value between 0 and 1."""
    low, high, x = 0.0, 1.0, value
    bend, cube = 3.0 - 2.0 * first - last, first + last - 2.0
    for _ in range(ITERATIONS):
        missing = value - _cubic(first, last, x)
        slope = first + x * (2.0 * bend + 3.0 * x * cube)
        low = select_positive(missing, x, low)
        high = select_positive(missing, high, x)
        better = x + missing / select_positive(abs(slope), slope, 1.0)
        inside = minimum(better - low, high - better)
        x = select_positive(inside, better, 0.5 * (low + high))
    return x
