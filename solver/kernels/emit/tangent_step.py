"""Records the step of a tangent vector: a method of order four along the base's step.

A tangent vector must not be carried by the base's own method, although that would make it the
exact derivative of the base's step. Where the base runs smoothly its step grows to the limit of
stability: contact oscillations that it does not follow, at hω = 1.8, and friction that holds a
joint, at h/τ = 3, neither grow nor die in it, which does no harm below its tolerance. A tangent has
no tolerance: what dies in the motion must die in it, or its exponent is too large (by a factor of
two on the press at tolerance 1e-6). The method here (`solver.kernels.emit.tangent_method`) makes
the same six evaluations.

In a step that ends a contact it ends where the gap opens, for there the stiffness of a linear law
is gone at once. Over the rest, a fiftieth of the step, the slope at its end is taken.
"""

from collections.abc import Sequence
from functools import reduce
from operator import add, mul

from jointplay.solver.kernels.emit.emit import lane_function
from jointplay.solver.kernels.emit.judged_step import where_accepted
from jointplay.solver.kernels.emit.judging import LANDED
from jointplay.solver.kernels.emit.kinks import MEMORY
from jointplay.solver.kernels.emit.tangent_method import COUPLING, NODES, STAGES, WEIGHTS
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.scalars import Scalar, maximum, minimum, select_positive

BEHIND_ONSET = {0: 0.021, 1: 0.216}
"""Shares of the step at which these stages look at the base, in a step that begins a contact.

The stiffness is a power of time there, from the zeroth, a jump, whose other side the state may be
on by rounding, to the root of Hertz's law. The length of that step does not depend on the
tolerance, and neither would the error. With these shares the weights integrate powers up to the
first, and their products with time, within 5e-4.
"""
BEFORE_OPENING = {4: 0.461, 5: 0.89}
"""The same in a step that ends a contact, within 2e-3: shares of the time until the gap opens.

At the shares of other steps roots count for 1 % too much, at each end of a contact: of a press
whose joints touch 80 times a second the exponent was 6.0 instead of 3.9 1/s at tolerance 1e-6.
"""


def allocate(layout: Layout, states: int) -> None:
    """Give slots to a tangent on its way through a step."""
    layout.add("passing_time", "begins", "spanned", "rest")
    kept = [f"kept{s}_" for s in range(STAGES - 1)]
    for name in ("passing", "carried", "carried_slope", *kept):
        layout.add_block(name, states)


class TangentTracer:
    """Records tangent_step(W) and what it calls, for the equations of a scene."""

    def __init__(self, equations: Equations, kinks: int, layout: Layout) -> None:
        self.states, self.coordinates = equations.states, len(equations.coordinates)
        self.closed = equations.loops is not None
        self.kinks, self.layout = kinks, layout
        self.pairs = len(equations.pairs)
        self.tracer = Tracer()

    def source(self) -> list[Source]:
        """Return the sources.

        tangent_step is to be called when a step was judged and its lanes' fate is known, before
        it is taken: ``y`` and ``k1_`` then belong to its start, ``stage`` and ``slope`` to its end,
        and ``accept`` tells which lanes take it.
        """
        stages = [line for s in range(STAGES) for line in (f"carry_{s}", "carried_slopes")]
        parts = [self._begin(), *(self._carry(s) for s in range(1, STAGES)), self._arrive()]
        calls = [f"call {each}" for each in ("kinks", *stages, "arrive")]
        if self.pairs:
            parts += self._behind()
            behind = [f"call {e}" for e in ("go_behind", "carried_slopes", "arrive_behind")]
            calls += [f"v0 = load {self.layout['rest']}", "if v0", *behind, "end"]
        if self.closed:
            calls.append("call hold_tangent")
        return [*parts, Source("tangent_step", tuple(calls))]

    def _begin(self) -> Source:
        """Stage 0, where the step begins, or just behind."""
        v, spanned, begins = self.tracer.variable, self._spanned(), self._begins()
        share = select_positive(begins, spanned * BEHIND_ONSET[0], 0.0)
        rest = select_positive(v("accept"), (1.0 - spanned) * v("tried"), 0.0)
        outputs = [("begins", begins), ("spanned", spanned), ("rest", rest)]
        outputs.append(("passing_time", v("time") + share * v("tried")))
        for i in range(self.states):
            outputs += [(f"passing{i}", self._passed(share, i)), (f"carried{i}", v(f"tangent{i}"))]
        return lane_function("carry_0", outputs, self.layout)

    def _begins(self) -> Scalar:
        """Return what is positive if a contact begins where the step does."""
        v, begins = self.tracer.variable, self.tracer.constant(0.0)
        for j in range(self.pairs):
            began = select_positive(v(f"penetration_start{j}") - LANDED, 0.0, 1.0)
            begins = select_positive(v(f"mode{j}"), maximum(begins, began), begins)
        return begins

    def _spanned(self) -> Scalar:
        """Return the share of the step that the method spans: all, or until a gap opens.

        Of the step little is left there (`solver.kernels.loop.openings`).
        """
        v, spanned = self.tracer.variable, self.tracer.constant(1.0)
        for j in range(self.pairs):
            share = minimum(spanned, (v(f"opened{j}") - v("time")) / v("tried"))
            opens = select_positive(v(f"penetration{j}"), spanned, share)
            opens = select_positive(v(f"penetration_start{j}") - LANDED, opens, spanned)
            spanned = select_positive(v(f"mode{j}"), opens, spanned)
        return spanned

    def _carry(self, s: int) -> Source:
        """Stage s: the point that the base passes there, and the tangent carried there."""
        v, share = self.tracer.variable, self._share(s, NODES[s])
        outputs = [("passing_time", v("time") + share * v("tried"))]
        for i in range(self.states):
            outputs += [(f"passing{i}", self._passed(share, i))]
            outputs += [(f"kept{s - 1}_{i}", self._slope(i))]
            outputs += [(f"carried{i}", self._moved(COUPLING[s], i))]
        return lane_function(f"carry_{s}", outputs, self.layout)

    def _share(self, s: int, share: Scalar) -> Scalar:
        """Return the share of the step at which stage s looks at the base."""
        v = self.tracer.variable
        if s in BEHIND_ONSET:
            share = select_positive(v("begins"), BEHIND_ONSET[s], share)
        if s in BEFORE_OPENING:
            share = select_positive(v("rest"), BEFORE_OPENING[s], share)
        return v("spanned") * share

    def _moved(self, weights: Sequence[float], i: int) -> Expression:
        """Component i behind its start: by slopes kept, and the one just evaluated as the last."""
        v = self.tracer.variable
        slopes = [*(v(f"kept{s}_{i}") for s in range(len(weights) - 1)), self._slope(i)]
        step = v("spanned") * v("tried")
        return v(f"tangent{i}") + step * reduce(add, map(mul, weights, slopes))

    def _slope(self, i: int) -> Expression:
        """Slope of component i at the stage just evaluated: of a coordinate's, its speed's."""
        count = self.coordinates
        name = f"carried{count + i}" if i < count else f"carried_slope{i}"
        return self.tracer.variable(name)

    def _passed(self, share: Scalar, i: int) -> Expression:
        """State i after a share of the step: the cubic through both ends and their slopes."""
        v, rest = self.tracer.variable, 1.0 - share
        start, end = v(f"y{i}"), v(f"stage{i}")
        first, last = v(f"k1_{i}"), v(f"slope{i}")
        slopes = (share * rest * rest) * first - (share * share * rest) * last
        return start + (share * share * (3.0 - 2.0 * share)) * (end - start) + v("tried") * slopes

    def _arrive(self) -> Source:
        """Bring the tangent over what the method spans, in the lanes that take the step."""
        v = self.tracer.variable
        moved = [(f"tangent{i}", self._moved(WEIGHTS, i)) for i in range(self.states)]
        moved += [(f"kink_start{i}", v(f"kink_end{i}")) for i in range(MEMORY * self.kinks)]
        return lane_function("arrive", where_accepted(moved), self.layout)

    def _behind(self) -> tuple[Source, Source]:
        """Bring the tangent over the rest of the step behind an opening, with the slope there."""
        v = self.tracer.variable
        passing = [("passing_time", v("time") + v("tried"))]
        moved = []
        for i in range(self.states):
            passing += [(f"passing{i}", v(f"stage{i}")), (f"carried{i}", v(f"tangent{i}"))]
            new = v(f"tangent{i}") + v("rest") * self._slope(i)
            moved.append((f"tangent{i}", select_positive(v("rest"), new, v(f"tangent{i}"))))
        return (
            lane_function("go_behind", passing, self.layout),
            lane_function("arrive_behind", moved, self.layout),
        )
