"""Whether a lane's step may be one to look into, for extremes that no scan of step ends finds.

It is asked after each attempt, of all lanes at once, and mostly answered by no: to go through the
lanes took longer than to scan all channels. Lanes that are looked after by themselves are gone
through anyway, whatever the answer is.
"""

from collections.abc import Callable

from jointplay.solver.kernels.emit import bends
from jointplay.solver.kernels.emit.emit import Tape
from jointplay.solver.kernels.emit.judging import PASSING
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.scalars import floor, greatest, maximum, select_positive

EVERY = 256
"""Steps from one look inside to the next, and those that are looked at after a rough one."""


def source(layout: Layout, pairs: int, *, always: bool) -> Source:
    """Return the source of foresee_looks(W): ``may_look`` is positive where a lane's step may be.

    Its value tells which lanes. `always` : of methods and scenes whose steps are all looked at.
    """
    tape, tracer = Tape(layout), Tracer()
    found = tracer.constant(1.0) if always else _may_be(tracer.variable, pairs)
    tape.store([("may_look", found)])
    tape.give(found)
    return tape.function("foresee_looks")


def _may_be(v: Callable[[str], Expression], pairs: int) -> Expression:
    rounds = (v("steps") + 1.0) * (1.0 / EVERY)
    due = maximum(v("rough_until") - v("steps"), 0.5 / EVERY - (rounds - floor(rounds)))
    inside = v("flag") - (PASSING - 0.5)  # these flags are the largest
    near = (bends.comes_near(v, j) for j in range(pairs))
    turning = (_turns_in_flight(v, j) for j in range(pairs))
    return greatest((*near, *turning), maximum(inside, due))


def _turns_in_flight(v: Callable[[str], Expression], j: int) -> Expression:
    """Return a number that is positive where the slip of pair j turns while that is open."""
    both = v(f"slip_rate_start{j}") * v(f"slip_rate{j}")
    return select_positive(v(f"mode{j}"), 0.0, -both)
