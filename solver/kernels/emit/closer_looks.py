"""Whether a lane's step may be one to look into, for extremes that no scan of step ends finds.

It is asked after each attempt, of all lanes at once, and mostly answered by no: to go through the
lanes took longer than to scan all channels. What has a lane looked after by itself is not asked.
"""

from jointplay.solver.kernels.emit import bends
from jointplay.solver.kernels.emit.emit import Tape, statements
from jointplay.solver.kernels.emit.judging import PASSING
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.quantities.scalars import floor, greatest, maximum

EVERY = 256
"""Steps from one look inside to the next, and those that are looked at after a rough one."""


def source(layout: Layout, pairs: int, *, always: bool) -> str:
    """Return the source of foresee_looks(W), whose value is positive where a lane may be.

    `always` : of methods and scenes whose steps are all looked at.
    """
    if always:
        return statements("foresee_looks", ["return 1.0"])
    tape, v = Tape(layout), Tracer().variable
    rounds = (v("steps") + 1.0) * (1.0 / EVERY)
    due = maximum(v("rough_until") - v("steps"), 0.5 / EVERY - (rounds - floor(rounds)))
    inside = v("flag") - (PASSING - 0.5)  # the flags of `INSIDE` are the largest
    near = (bends.comes_near(v, j) for j in range(pairs))
    tape.give(greatest(near, maximum(inside, due)))
    return tape.function("foresee_looks")
