"""Whether a slip may pass a bend of friction inside a step and come back, or pass more than one.

Both is told by its values and rates at both ends: one bend that is passed once shows there. Looked
at for all lanes at once, for in most steps it is in none of them.
"""

from collections.abc import Callable, Sequence
from functools import reduce
from operator import add

from jointplay.solver.kernels.emit.emit import lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import BENDS, Layout
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.scalars import maximum, minimum, select_positive, sqrt

BEYOND = 0.5
"""Part of what a cubic goes beyond its ends by which slip may go further than the cubic."""
RATES = 0.02
"""Part of the way at the rates of both ends by which slip may go further, too."""
HALF = 0.5
"""Between two counts."""
NEAR = 0.25
"""The most that slip goes beyond its ends, in changes over the step at the rates of both: a cubic
4/27, slip (1 + BEYOND) times as far, and RATES."""
ROUNDING = 1e-9
"""Share of slips by which all that may differ."""


def allocate(layout: Layout, pairs: int) -> None:
    """Give slots to the speeds at which friction bends, m/s, and to whether one may be passed."""
    layout.add_block("bend", BENDS * pairs)
    layout.add("may_pass_bend")


def source(layout: Layout, pairs: int) -> Source:
    """Return the source of foresee_bends(W), which says so by positive numbers."""
    if pairs == 0:
        return Source("foresee_bends")
    tracer = Tracer()
    passes = [_passes(tracer.variable, j) for j in range(pairs)]
    return lane_function("foresee_bends", [("may_pass_bend", reduce(maximum, passes))], layout)


def comes_near(v: Callable[[str], Expression], j: int) -> Expression:
    """Return a number that is positive where pair j may pass, and wherever else a bend is near."""
    before, now = v(f"slip_start{j}"), v(f"slip{j}")
    rates = v("tried") * (abs(v(f"slip_rate_start{j}")) + abs(v(f"slip_rate{j}")))
    middle = 0.5 * abs(before + now)  # the same either way
    distances = (abs(middle - v(f"bend{k}")) for k in range(BENDS * j, BENDS * (j + 1)))
    reach = 0.5 * abs(now - before) + NEAR * rates + ROUNDING * (abs(before) + abs(now))
    return select_positive(v(f"mode{j}"), reach - reduce(minimum, distances), 0.0)


def _passes(v: Callable[[str], Expression], j: int) -> Expression:
    """Return a number that is positive where the slip of pair j may pass, in contact."""
    before, now = v(f"slip_start{j}"), v(f"slip{j}")
    begin, end = v("tried") * v(f"slip_rate_start{j}"), v("tried") * v(f"slip_rate{j}")
    below, above = _beyond_ends(now - before, begin, end)
    margin = RATES * (abs(begin) + abs(end))
    low, high = minimum(before, now), maximum(before, now)
    least = low - (1.0 + BEYOND) * below - margin
    most = high + (1.0 + BEYOND) * above + margin
    bends = [v(f"bend{k}") for k in range(BENDS * j, BENDS * (j + 1))]
    first, last = _bends_below(low, bends), _bends_below(high, bends)
    beneath, beyond = first - _bends_below(least, bends), _bends_below(most, bends) - last
    passes = maximum(last - first - 1.0 - HALF, maximum(beneath, beyond) - HALF)
    return select_positive(v(f"mode{j}"), passes, 0.0)


def _beyond_ends(
    change: Expression, begin: Expression, end: Expression
) -> tuple[Expression, Expression]:
    """Return how far a cubic goes below and above both of its ends, from 0 to `change`.

    `begin`, `end` : its slopes there, as changes over the whole step.
    """
    curving, bending = 6.0 * change - 4.0 * begin - 2.0 * end, 3.0 * (begin + end) - 6.0 * change
    root = curving * curving - 4.0 * bending * begin  # of the cubic's slope, a parabola
    spread = sqrt(maximum(root, 0.0))
    q = -0.5 * (curving + select_positive(curving, spread, -spread))
    least = most = 0.0
    for above_line, below_line in ((q, bending), (begin, q)):
        both = above_line * below_line
        inside = minimum(root, minimum(both, below_line * below_line - both))
        share = above_line / below_line
        value = share * (begin + share * (0.5 * curving + share * bending / 3.0))
        value = select_positive(inside, value, 0.0)  # its value where it begins
        least, most = minimum(least, value), maximum(most, value)
    below = minimum(change, 0.0) - minimum(least, change)
    return below, maximum(most, change) - maximum(change, 0.0)


def _bends_below(slip: Expression, bends: Sequence[Expression]) -> Expression:
    """Return how many bends, either way, a slip is above."""
    ways = [way for bend in bends for way in (slip - bend, slip + bend)]
    return reduce(add, (select_positive(way, 1.0, 0.0) for way in ways))
