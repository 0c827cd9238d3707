"""The scan for extremes: which channels of which lanes just passed one that may be a new extreme.

It looks at the values at step ends only to find candidates; the extremes themselves are then
sought inside the steps on the dense output (`solver.kernels.loop.extremes.peaks`).
Before the second step there is no change before: it is NaN, and no candidate.
"""

from jointplay.solver.kernels.emit.emit import Output, Tape
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import WIDTHS
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.quantities.scalars import minimum, select_positive

BLOCKS = ("channel", "previous", "change", "highest", "lowest")

BYTES = 8 * min(WIDTHS.values())
"""Marks in a slot, one byte for each row, whose bits are the lanes, at any width."""

REACH, SPARE = 3.0, 0.06
"""Bounds of an extreme beyond the step end between two steps, within which it is looked for.

The parabola through three step ends reaches (r q² + c)² / (4 q (q + 1) |c - r q|) beyond the middle
one, if the changes are r (before) and c (after) and the second step is q times as long; a sine
sampled every 1.5 rad, the limit of stability, up to 1.6 times as far. REACH covers that, SPARE the
even case: steps of a third order at that limit turn at every end, 0.035 of both changes beyond."""

UNSEEN, TIMES = 1e-5, 4.0
"""Share of its range by which a channel may swing inside steps that it rises or falls through and
not be noticed, and how many times as far as it changes in the steps where it turns.

One that turns more slowly than that swings beyond its step ends, in steps before, and is looked at.
"""


def allocate(layout: Layout, rows: int, rest: int) -> None:
    """Give slots to `rows` channel values, their predecessors, changes and extremes so far.

    Also to the range below which each is ``rounding``, to the first row that is ``alike``, and to
    whether it is ``bent`` where friction is.
    `rest` further channel values are not scanned.
    """
    layout.add_block("marked", -(-rows // BYTES))
    layout.add_block("channel", rows + rest)
    known = ("highest_time", "lowest_time", "known_range", "rounding", "alike", "bent")
    for block in (*BLOCKS[1:], *known):
        layout.add_block(block, rows)


def reach(step: Expression, before: Expression) -> list[Output]:
    """Return what all rows need of the lengths of this step and of the one before."""
    longer = step / before
    return [("lengthening", longer), ("reach", 0.25 * REACH / (longer * (longer + 1.0)))]


def source(layout: Layout, rows: int) -> list[Source]:
    """Return the sources of scan(W), and of scan_some(W) for the lanes that accept their step.

    Their value, and for each row a byte of `marked`, tell the lanes with a candidate, a bit each;
    a lane that does not accept its step has none, whatever its bit says.
    """
    return [_scan(name, layout, rows) for name in ("scan", "scan_some")]


def _scan(name: str, layout: Layout, rows: int) -> Source:
    tracer = Tracer()
    value, before, rose, highest, lowest = (tracer.variable(f"{block}0") for block in BLOCKS)
    change = value - before
    nearest = minimum(highest - before, before - lowest)
    longer, far = tracer.variable("lengthening"), tracer.variable("reach")
    onwards = longer * rose
    both, uneven = abs(onwards - change), longer * onwards + change
    unseen = minimum(UNSEEN * (highest - lowest), TIMES * both)
    found = far * uneven * uneven + (SPARE * both + unseen - nearest) * both
    found = select_positive(rose * change, 0.0, found)  # signs differ where it turned
    if name == "scan_some":
        accepted = tracer.variable("accept")
        value = select_positive(accepted, value, before)
        change = select_positive(accepted, change, rose)
    blocks = {f"{block}0" for block in BLOCKS}
    tape = Tape(layout, fetch=lambda name: f"load {layout[name]}{'+' * (name in blocks)}")
    tape.mark("marked0", found)  # of what the rows hold before
    tape.store_rows([("previous0", value), ("change0", change)])
    return tape.function(name, "rows", rows)
