"""Records how a step is judged: its error, the length of the next one, what needs attention."""

from collections.abc import Iterable
from functools import reduce
from itertools import count
from operator import add

from jointplay.solver.integrators import Method
from jointplay.solver.kernels.emit import closing, enclosure, scanning
from jointplay.solver.kernels.emit.emit import Output, Outputs, Tape, lane_function
from jointplay.solver.kernels.emit.judging import (
    DUE,
    PACE,
    REJECTED,
    SWINGING,
    contact_flags,
    growth,
    jumps,
    passing_flag,
    swings,
)
from jointplay.solver.kernels.emit.knots import KnotTracer
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.elementary import coarse_log2
from jointplay.solver.quantities.scalars import SLIGHT, maximum, minimum, select_positive

SMALLEST_ERROR = 1e-16
"""Floor under the squared error, so that its logarithm exists; errors below 1e-8 count alike."""
GROWN = 2.0
"""A step that many times as long as the last one that was looked into is, too, if it swings."""
LEFT = 4.5
"""Steps since one was due to be looked into, within which one so long is in any case: it left the
limit of stability, and its late stages may look alike though friction reversed inside."""


def before(name: str) -> str:
    """Return the slot of a quantity of the step before."""
    return {"tried": "before_step"}.get(name, f"before_{name}")


def where_accepted(outputs: Outputs) -> list[Output]:
    """Return outputs that leave slots as they are in lanes that do not take the step.

    Nodes have an order within one trace only, and some outputs are of that of the equations.
    """
    return [
        (slot, new.tracer.variable("accept").select_positive(new, new.tracer.variable(slot)))
        for slot, new in outputs
    ]


class JudgedStep:
    """A step of one method for the equations of a scene, and the function that judges it."""

    unweighed = 0
    """Slopes kept before those that the error weighs."""

    def __init__(self, tableau: Method, equations: Equations, layout: Layout) -> None:
        self.tableau, self.equations = tableau, equations
        # fixed steps end where they end
        self.knots = KnotTracer(equations.knots if tableau.error else (), layout)
        self.states, self.coordinates = equations.states, len(equations.coordinates)
        self.ledger, self.pairs = len(equations.ledger), len(equations.pairs)
        self.angles = [i for i, name in enumerate(equations.coordinates) if name.endswith(".theta")]
        self.layout = layout
        self.tracer = Tracer()
        self.variable = self.tracer.variable

    def _sum(self, weights: Iterable[float | Expression], slots: Iterable[str]) -> Expression:
        """Return a weighted sum of slots, of as many as there are weights."""
        total: Expression = self.tracer.constant(0.0)
        for weight, slot in zip(weights, slots, strict=False):
            total = total + weight * self.variable(slot)
        return total

    def _function(self, name: str, outputs: Outputs) -> Source:
        return lane_function(name, outputs, self.layout)

    def _slope(self, s: int, i: int) -> str:
        """Return the slot of the slope of state i at stage s: the last is where the step ends."""
        return f"slope{i}" if s == self.tableau.stages else f"k{s}_{i}"

    def _judge(self) -> Source:
        """Error of the step, the next step size, and what needs attention."""
        v = self.variable
        squared = self._squared_error() if self.tableau.error else self._overflow()
        good = select_positive(1.0 + 1e-12 - squared, 1.0, 0.0)
        magnitude = 0.5 * coarse_log2(squared)
        if self.tableau.error:
            next_step = v("tried") * growth(self.tableau.error_order, good, magnitude, v("memory"))
        else:  # fixed; after an overflow there is none
            next_step = select_positive(good, v("step"), 0.0)
        good, next_step, resumed = self._at_knots(good, next_step)
        due = select_positive(v("next_due") - v("arrival"), 0.0, DUE)
        pace = select_positive(v("steps") + 1.5 - v("pace_at"), PACE, 0.0)
        attention = REJECTED * (1.0 - good) + due + pace
        away = self._away()
        flags = [
            contact_flags(v, j, away, shape, self.tableau)
            for j, shape in enumerate(self.equations.enclosures)
        ]
        kinds = [reduce(maximum, kind) for kind in zip(*flags, strict=True)]
        attention = select_positive(v("active"), reduce(add, kinds, attention), 0.0)
        inside = select_positive(v("active"), v("inside"), 0.0)
        outputs = [
            ("accept", good * v("active")),
            ("flag", attention + inside),
            ("next_step", next_step),
            *resumed,
            ("new_memory", magnitude),
        ]
        tape = Tape(self.layout)
        tape.store(outputs)
        tape.give(attention)
        return tape.function("judge")

    def _look_inside(self) -> Source:
        """Return the source of look_inside(W): what extremes and crossings ask of a step."""
        v = self.variable
        swinging, swing = self._swinging()
        shapes = enumerate(self.equations.enclosures)
        passing = reduce(maximum, (passing_flag(v, j, shape) for j, shape in shapes), 0.0)
        tape = Tape(self.layout)
        tape.go_on_where(v("looks_inside"))
        reach = scanning.reach(v("tried"), v(before("tried")))
        inside = select_positive(v("looks_inside"), swinging + passing, 0.0)
        tape.store([("inside", inside), ("swing", swing), *reach])
        return tape.function("look_inside")

    def _at_knots(
        self, good: Expression, next_step: Expression
    ) -> tuple[Expression, Expression, Outputs]:
        """Return what knots make of whether a step is good and of the next one, and what to keep.

        Steps go on as long as they were before a knot. One that would leave a sliver before the
        next knot of a clock goes half the way.
        """
        v, resumed = self.variable, list[Output]()
        onwards = next_step
        if self.knots.clocked:
            rest = v("to_knot") - v("tried")
            reached = minimum(next_step, v("largest_step"))
            sliver = minimum(rest - reached, 2.0 * reached - rest)
            onwards = select_positive(sliver, 0.5 * rest, onwards)
            shortened = v("unhindered") - v("tried")
            onwards = select_positive(shortened, maximum(next_step, v("unhindered")), onwards)
        if self.knots.met:
            passed = 1.0 - v("knot_share")
            onwards = maximum(onwards, v("resumed"))
            kept = maximum(minimum(v("tried"), next_step), v("resumed"))
            resumed = [("resumed", select_positive(passed, kept, 0.0))]
            next_step = select_positive(passed, v("knot_share") * v("tried"), next_step)
            good = select_positive(passed, 0.0, good)
        return good, select_positive(good, onwards, next_step), resumed

    def _swinging(self) -> tuple[Expression, Expression]:
        """Return SWINGING where a step that swings inside is to be looked at, and by how much.

        In tolerances of the speed, of the acceleration that swings most. Methods that are watched
        closely need no flag for it, nor do implicit ones, which no limit of stability makes swing.
        """
        most: Expression = self.tracer.constant(0.0)
        if self.tableau.watched_closely:
            return most, most
        v, last = self.variable, self.tableau.stages
        shorter = 1.0 / v("tried")
        for i in range(self.coordinates, 2 * self.coordinates):
            first, second, late, end = (v(self._slope(s, i)) for s in (1, 2, last - 1, last))
            swing = swings(first, late, end, self.tableau.nodes[-2], self._weighed(i))
            mean = shorter * (v(f"stage{i}") - v(f"y{i}"))
            jump = jumps(first, second, mean, end, self._weighed(i))
            most = maximum(most, maximum(swing, jump))
        is_time = maximum(v("steps") + 0.5 - v("look_at"), most - v("look_beyond"))
        longer = v("tried") - GROWN * v("looked_into")
        ago = v("steps") - v("look_at")
        leaves = minimum(minimum(ago + 1.5, LEFT - ago), longer)
        wanted = maximum(minimum(most, maximum(is_time, longer)), leaves)
        return select_positive(wanted, SWINGING, 0.0), most

    def _away(self) -> Expression:
        """Return what journals may be away from the quintic that encloses them, m."""
        speeds = [self.coordinates + i for i in self.angles]
        return enclosure.remainder(
            self.variable,
            [f"{state}{i}" for i in speeds for state in ("y", "stage")],
            [f"{slope}{i}" for i in speeds for slope in ("k1_", "slope")],
        )

    def _squared_error(self) -> Expression:
        """Square of the step's error, in tolerances."""
        squared = self._sum_of_squares(self.tableau.error)
        if self.tableau.coarse_error:
            coarse = 0.01 * self._sum_of_squares(self.tableau.coarse_error)
            squared = squared * (squared / (squared + coarse))
        if self.equations.corrections:
            squared = squared + closing.drift(self.variable, self.coordinates)
        return squared

    def _sum_of_squares(self, weights: tuple[float, ...]) -> Expression:
        """Sum over the states of (h Σ e k / weight of the state)², not quite zero."""
        squared: Expression = self.tracer.constant(SMALLEST_ERROR)
        for i in range(self.states):
            error = self._sum(weights, (self._slope(s, i) for s in count(1 + self.unweighed)))
            scaled = error * self._weighed(i)
            squared = squared + scaled * scaled
        return squared

    def _weighed(self, i: int) -> Expression:
        """Step times weight of state i; more, while nothing has moved as fast as it may."""
        v = self.variable
        return v("tried") * (v("full") / v("fastest")) * v(f"weight{i}")

    def _overflow(self) -> Expression:
        """Almost zero, but infinite or NaN where a slope is."""
        overflow: Expression = self.tracer.constant(SMALLEST_ERROR)
        for i in range(self.states):
            overflow = overflow + SLIGHT * abs(self.variable(f"slope{i}"))
        return overflow
