"""Closer looks at a bracket: where its next nodes are, and what is left of it then.

A look has four instants that are not known yet. Where the extreme is foretold between two nodes,
they are close to there: if it is among them, the bracket is narrowed to a twelfth, and to the
square of that share by the next look, for what a foretelling errs by falls so. If it is not, they
divide the part between the nodes beside the best one evenly.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.brackets import (
    ABSCISSA,
    BEST,
    CLOSER,
    IN_THIS,
    MOST_ROUNDS,
    NARROWING,
    ROUNDS,
    ROW,
    SENSE,
    SPACING,
    START,
    VALUES,
)
from jointplay.solver.kernels.loop.extremes.extreme import LAST, MIDDLE, NODES, highest
from jointplay.solver.kernels.loop.extremes.extreme_so_far import count
from jointplay.solver.kernels.loop.extremes.rounding import spread_of, zigzags
from jointplay.solver.kernels.loop.step import Step

HALF = 4
"""Instants of a look: as many as `channels_around` takes in each of two steps."""
AROUND, FIFTHS, THIRDS = 4, 5, 6
"""Parts of a look: about where the extreme is foretold; between the best node, an end of the
bracket, and the one beside it; between the two beside it."""
FIRST = 1.0 / 12.0
"""Share of the spacing to which the first look where it is foretold narrows a bracket."""
WIDEST = 0.25
"""Largest such share: the last of its nodes is the next one of the bracket."""
AGAIN = 3
"""A look where it is foretold is tried again behind rounds that are multiples of this."""
STILL = 0.5
"""Values of a narrow look that differ by more than this share of what those of its bracket do are
rounding, if they zigzag."""


@inner_kernel()
def closer(w: int, table: np.ndarray) -> tuple[float, float, int, int]:
    """Return the next look at a bracket: its first node, their distance, parts and known node.

    The known node is that of a look where the extreme is foretold; others know the nodes at both
    ends, and of thirds the middle one.
    """
    best, start, spacing = int(table[w + BEST]), table[w + START], table[w + SPACING]
    if best in (0, LAST):
        left = max(best - 1, 0)
        return start + left * spacing, spacing / FIFTHS, FIFTHS, 0
    share = table[w + NARROWING]
    if share == 0.0 or best != MIDDLE:
        return start + (best - 1) * spacing, 2.0 * spacing / THIRDS, THIRDS, 0
    ahead = table[w + ABSCISSA] - best
    if abs(ahead) <= 2.0 * share:
        known = MIDDLE
    else:
        known = 0 if ahead > 0.0 else LAST
        share = min(0.5 * abs(ahead), WIDEST)
    return start + (best - known * share) * spacing, share * spacing, AROUND, known


@inner_kernel()
def is_known(k: int, parts: int, known: int) -> bool:
    """Whether a look has the value at a node already."""
    if parts == AROUND:
        return k == known
    return k in (0, parts) or 2 * k == THIRDS == parts


@inner_kernel()
def place_closer(start: float, spacing: float, parts: int, known: int, first: int, s: Step) -> None:
    """Place the instants of a look, in columns from `first`."""
    column = first
    for k in range(parts + 1):
        if not is_known(k, parts, known):
            s.spare[s.at.theta, column] = min(max(start + k * spacing, 0.0), 1.0)
            column += 1


@inner_kernel()
def read_look(w: int, parts: int, known: int, s: Step) -> None:
    """Write the values of a look at a bracket, in the order of time."""
    table, best = s.table, int(s.table[w + BEST])
    row, column = s.at.channel + int(table[w + ROW]), HALF * int(table[w + IN_THIS])
    for k in range(parts + 1):
        if not is_known(k, parts, known):
            table[CLOSER + k] = s.spare[row, column]
            column += 1
        elif parts == AROUND:
            table[CLOSER + k] = table[w + VALUES + best]
        else:
            behind = k // 3 if parts == THIRDS else k // FIFTHS
            table[CLOSER + k] = table[w + VALUES + max(best - 1, 0) + behind]


@inner_kernel()
def shows_rounding(w: int, parts: int, table: np.ndarray) -> bool:
    """Whether a look at a part of a bracket turns twice, and differs by as much as the whole."""
    behind = CLOSER + parts + 1
    before = spread_of(table, w + VALUES, w + VALUES + NODES)
    narrow = parts != THIRDS and zigzags(table, CLOSER, behind)
    return narrow and spread_of(table, CLOSER, behind) > STILL * before


@inner_kernel()
def narrow(w: int, start: float, spacing: float, parts: int, known: int, s: Step) -> bool:
    """Narrow a bracket to five nodes about the best one of a look, or leave it if it is outside.

    Returns whether it has new nodes to be judged. If it is nothing but rounding, it is done.
    """
    table = s.table
    read_look(w, parts, known, s)
    rounding = shows_rounding(w, parts, table)
    best = highest(table, CLOSER, CLOSER + parts + 1, table[w + SENSE]) - CLOSER
    table[w + ROUNDS] += 1.0
    if parts == AROUND:
        share = spacing / table[w + SPACING]
        table[w + NARROWING] = share * share
        if best in (0, LAST):
            table[w + NARROWING] = 0.0
            abscissa = (start + best * spacing - table[w + START]) / table[w + SPACING]
            count(w, abscissa, table[CLOSER + best], s)
            if rounding:
                table[w + ROUNDS] = MOST_ROUNDS
            return False
    elif table[w + NARROWING] == 0.0 and table[w + ROUNDS] % AGAIN == 0.0:
        table[w + NARROWING] = FIRST
    kept = min(max(best - NODES // 2, 0), parts + 1 - NODES)
    for i in range(NODES):
        table[w + VALUES + i] = table[CLOSER + kept + i]
    table[w + BEST] = best - kept
    table[w + START], table[w + SPACING] = start + kept * spacing, spacing
    if rounding:
        table[w + ROUNDS] = MOST_ROUNDS
    return not rounding
