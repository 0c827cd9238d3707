"""Records the step of a tangent vector: two half steps of Ralston's method along the base's step.

A tangent vector must not be carried by the base's own method, although that would make it the
exact derivative of the base's step. Where the base runs smoothly its step grows to the limit of
stability: contact oscillations that it does not follow, at hω = 1.8, and friction that holds a
joint, at h/τ = 3, neither grow nor die in it, which does no harm below its tolerance. A tangent has
no tolerance: what dies in the motion must die in it, or its exponent is too large (by a factor of
two on the press at tolerance 1e-6). Two half steps of a method of order three make the same six
evaluations and are stable and damped up to hω = 3.4, h/τ = 5.

Source: Ralston 1962, Mathematics of Computation 16:431 (minimum error bound of order three); the
same nodes and weights as in Bogacki and Shampine 1989, Applied Mathematics Letters 2:321.
"""

from functools import reduce
from operator import add, mul

from jointplay.solver.kernels.emit.emit import lane_function, statements
from jointplay.solver.kernels.emit.judging import LANDED
from jointplay.solver.kernels.emit.kinks import MEMORY
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.scalars import Scalar, maximum, select_positive

NODES = (0.0, 0.5, 0.75)
"""Stages of a half step; stage s starts from the slope of the stage before alone, weight NODES."""
WEIGHTS = (2.0 / 9.0, 3.0 / 9.0, 4.0 / 9.0)
STAGES = 2 * len(NODES)
BEHIND_ONSET = 0.05
"""Node 0 of the first half step of a step with which a contact begins.

The slope may jump there, such as by the stiffness of a linear law, and the state is on either side
of the jump, by rounding. The length of that step does not depend on the tolerance, and neither
would the error. With the node here the weights integrate a jump exactly, powers of time up to the
root within 4e-3, and time itself within 0.012.
"""


def allocate(layout: Layout, states: int) -> None:
    """Give slots to a tangent on its way through a step."""
    layout.add("passing_time")
    for name in ("passing", "carried", "carried_slope", "middle", "first_slope", "second_slope"):
        layout.add_block(name, states)


class TangentTracer:
    """Records tangent_step(W) and what it calls, for the equations of a scene."""

    def __init__(self, equations: Equations, kinks: int, layout: Layout) -> None:
        self.states, self.coordinates = equations.states, len(equations.coordinates)
        self.closed = equations.loops is not None
        self.kinks, self.layout = kinks, layout
        self.pairs = len(equations.pairs)
        self.tracer = Tracer()

    def source(self) -> str:
        """Return the source.

        tangent_step is to be called when a step was judged and its lanes' fate is known, before
        it is taken: ``y`` and ``k1_`` then belong to its start, ``stage`` and ``slope`` to its end,
        and ``accept`` tells which lanes take it.
        """
        calls = [line for s in range(STAGES) for line in (f"carry_{s}", "carried_slopes")]
        calls = ["kinks", *calls, "arrive"]
        if self.closed:
            calls.append("hold_tangent")
        parts = [self._begin(), *(self._carry(s) for s in range(1, STAGES)), self._arrive()]
        step = statements("tangent_step", [f"call {each}" for each in calls])
        return "\n\n".join([*parts, step])

    def _begin(self) -> str:
        """Stage 0, where the step begins, or just behind."""
        v, share = self.tracer.variable, self._begins()
        outputs = [("passing_time", v("time") + share * v("tried"))]
        for i in range(self.states):
            outputs += [(f"passing{i}", self._passed(share, i)), (f"carried{i}", v(f"tangent{i}"))]
        return lane_function("carry_0", outputs, self.layout)

    def _begins(self) -> Scalar:
        """Return the share of the step at which stage 0 is: not 0 where a contact begins there."""
        v, share = self.tracer.variable, 0.0
        for j in range(self.pairs):
            began = select_positive(v(f"gap_start{j}") - LANDED, 0.0, 0.5 * BEHIND_ONSET)
            share = select_positive(v(f"mode{j}"), maximum(share, began), share)
        return share

    def _carry(self, s: int) -> str:
        """Stage s: the point that the base passes there, and the tangent carried there."""
        v = self.tracer.variable
        half, stage = divmod(s, len(NODES))
        share = 0.5 * (half + NODES[stage])
        outputs = [("passing_time", v("time") + share * v("tried"))]
        outputs += [(f"passing{i}", self._passed(share, i)) for i in range(self.states)]
        for i in range(self.states):
            begun = v(f"middle{i}") if half else v(f"tangent{i}")
            slope = self._slope(i)
            if stage == 0:
                middle = self._after_half(v(f"tangent{i}"), i)
                outputs += [(f"middle{i}", middle), (f"carried{i}", middle)]
                continue
            kept = "first_slope" if stage == 1 else "second_slope"
            outputs.append((f"carried{i}", begun + (0.5 * NODES[stage]) * v("tried") * slope))
            outputs.append((f"{kept}{i}", slope))
        return lane_function(f"carry_{s}", outputs, self.layout)

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

    def _after_half(self, begun: Expression, i: int) -> Expression:
        v = self.tracer.variable
        slopes = [v(f"first_slope{i}"), v(f"second_slope{i}"), self._slope(i)]
        return begun + 0.5 * v("tried") * reduce(add, map(mul, WEIGHTS, slopes))

    def _arrive(self) -> str:
        """Bring the tangent to the end of the step, in the lanes that take it."""
        v = self.tracer.variable
        moved = [(f"tangent{i}", self._after_half(v(f"middle{i}"), i)) for i in range(self.states)]
        moved += [(f"kink_start{i}", v(f"kink_end{i}")) for i in range(MEMORY * self.kinks)]
        taken = [(name, select_positive(v("accept"), new, v(name))) for name, new in moved]
        return lane_function("arrive", taken, self.layout)
