"""The scan for extremes: which channels of which lanes just passed one that may be a record.

It looks at the values at step ends only to find candidates; the extremes themselves are then
sought inside the steps on the dense output (`solver.lanes.peaks`). The values themselves move to
the block ``previous``; in their place stays how likely a candidate each is (positive: one).
Before the second step there is no change before: it is not a number, and no candidate.
"""

from __future__ import annotations

from solver.compiler.emit import RETURNING
from solver.compiler.layout import LANES, Layout

BLOCKS = ("channel", "previous", "change", "highest", "lowest")

CHAINS = 4
"""Independent maxima in the reduction over rows: one would wait for its own latency."""

LOPSIDED, SPARE = 0.3, 0.02
"""How far an extreme may lie beyond the step end between the changes r (before) and c (after).

A parabola reaches (r + c)² / (8 (|r| + |c|)) beyond, nothing where the changes are equal and
opposite; a sine sampled every 1.5 rad, the limit of stability, up to 1.6 times as far. LOPSIDED
covers that with room for unequal steps, SPARE the even case."""


def allocate(layout: Layout, rows: int, rest: int) -> None:
    """Give slots to `rows` channel values, their predecessors, changes and records.

    `rest` further channel values are not scanned.
    """
    layout.add("peak")
    layout.add_block("channel", rows + rest)
    for block in (*BLOCKS[1:], "highest_time", "lowest_time"):
        layout.add_block(block, rows)


def source(layout: Layout, rows: int) -> str:
    """Return the source of scan(W), and of scan_some(W) for the lanes that accept their step."""
    return "\n\n".join([_scan(layout, rows, some=False), _scan(layout, rows, some=True)])


def _scan(layout: Layout, rows: int, *, some: bool) -> str:
    at = {name: layout[f"{name}0"] * LANES for name in BLOCKS}
    change, found = "change", "within"
    value = "value"
    if some:
        kept = f"if W[{layout['taken0'] * LANES} + i] > 0.0 else"
        value, change, found = (
            f"value {kept} before",
            f"change {kept} rose",
            f"within {kept} 0.0",
        )
    body = f"""    for i in range({rows * LANES}):
        value = W[{at["channel"]} + i]
        before = W[{at["previous"]} + i]
        rose = W[{at["change"]} + i]
        change = value - before
        above = W[{at["highest"]} + i] - before
        below = before - W[{at["lowest"]} + i]
        nearest = above if above < below else below
        both = abs(rose) + abs(change)
        uneven = rose + change
        within = {LOPSIDED} * uneven * uneven + ({SPARE} * both - nearest) * both
        within = 0.0 if rose * change > 0.0 else within
        W[{at["channel"]} + i] = {found}
        W[{at["previous"]} + i] = {value}
        W[{at["change"]} + i] = {change}"""
    name = "scan_some" if some else "scan"
    return "\n".join([RETURNING, f"def {name}(W):", body, _largest(layout, at, rows)])


def _largest(layout: Layout, at: dict[str, int], rows: int) -> str:
    """Largest candidate of each lane, then of all."""
    peak = layout["peak"] * LANES
    lines = []
    for row in range(rows):
        slot = at["channel"] + row * LANES
        chain = f"found{row % CHAINS}"
        if row < CHAINS:
            lines.append(f"        {chain} = W[{slot} + l]")
        else:
            lines.append(f"        other = W[{slot} + l]")
            lines.append(f"        {chain} = other if other > {chain} else {chain}")
    lines += [
        f"        found0 = found{other} if found{other} > found0 else found0"
        for other in range(1, min(CHAINS, rows))
    ]
    largest = "\n".join(lines)
    return f"""    for l in range({LANES}):
{largest}
        W[{peak} + l] = found0
    largest = 0.0
    for l in range({LANES}):
        largest = W[{peak} + l] if W[{peak} + l] > largest else largest
    return largest
"""
