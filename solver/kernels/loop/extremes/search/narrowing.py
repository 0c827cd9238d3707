"""Closer looks at a bracket: where its next nodes are, and what is left of it then.

A look has four instants that are not known yet. Where the extreme is foretold between two nodes,
they are close to there: if it is among them, the bracket is narrowed to a twelfth, and to the
square of that share by the next look, for what a foretelling errs by falls so. If it is not, they
divide the part between the nodes beside the best one evenly.
"""

from typing import NamedTuple

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.search.brackets import (
    LAST,
    MIDDLE,
    MOST_ROUNDS,
    NODES,
    Bracket,
)
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import count
from jointplay.solver.kernels.loop.extremes.search.rounding import spread_of, zigzags
from jointplay.solver.kernels.loop.step import Step

PER_STEP = 4
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
INSTANT = 2.0**-52
"""Share of a step within which all nodes of a look are one instant."""
STILL = 0.5
"""Values of a narrow look that differ by more than this share of what those of its bracket do are
rounding, if they zigzag."""


class Look(NamedTuple):
    """Even nodes of a closer look at a bracket; four are instants that are not known yet."""

    start: float
    """First node, as a share of the step."""
    spacing: float
    parts: int
    """From the first node to the last: `AROUND`, `FIFTHS` or `THIRDS`."""
    known: int
    """Node that is known where the extreme is foretold: the bracket's best one. Others know those
    at both ends, and of thirds the middle one."""


@inner_kernel()
def closer(bracket: Bracket) -> Look:
    """Return the next look at a bracket."""
    best, start, spacing = bracket.best, bracket.start, bracket.spacing
    if best in (0, LAST):
        left = max(best - 1, 0)
        return Look(start + left * spacing, spacing / FIFTHS, FIFTHS, 0)
    share = bracket.narrowing
    if share == 0.0 or best != MIDDLE:
        return Look(start + (best - 1) * spacing, 2.0 * spacing / THIRDS, THIRDS, 0)
    ahead = bracket.abscissa - best
    if abs(ahead) <= 2.0 * share:
        known = MIDDLE
    else:
        known = 0 if ahead > 0.0 else LAST
        share = min(0.5 * abs(ahead), WIDEST)
    return Look(start + (best - known * share) * spacing, share * spacing, AROUND, known)


@inner_kernel()
def is_known(k: int, look: Look) -> bool:
    """Whether a look has the value at a node already."""
    if look.parts == AROUND:
        return k == look.known
    return k in (0, look.parts) or 2 * k == THIRDS == look.parts


@inner_kernel()
def place_closer(look: Look, first: int, s: Step) -> None:
    """Place the instants of a look, in columns from `first`."""
    column = first
    for k in range(look.parts + 1):
        if not is_known(k, look):
            share = look.start + k * look.spacing
            s.spare[s.at.theta, column] = min(max(share, 0.0), 1.0)
            column += 1


@inner_kernel()
def read_look(bracket: Bracket, look: Look, s: Step) -> None:
    """Write what a look at a bracket has seen."""
    best, parts = bracket.best, look.parts
    row, column = s.at.channel + bracket.row, PER_STEP * bracket.step
    for k in range(parts + 1):
        if not is_known(k, look):
            bracket.seen[k] = s.spare[row, column]
            column += 1
        elif parts == AROUND:
            bracket.seen[k] = bracket.values[best]
        else:
            behind = k // 3 if parts == THIRDS else k // FIFTHS
            bracket.seen[k] = bracket.values[max(best - 1, 0) + behind]


@inner_kernel()
def shows_rounding(bracket: Bracket, parts: int) -> bool:
    """Whether a look at a part of a bracket turns twice, and differs by as much as the whole."""
    narrow = parts != THIRDS and zigzags(bracket.seen, parts + 1)
    return narrow and spread_of(bracket.seen, parts + 1) > STILL * spread_of(bracket.values, NODES)


@inner_kernel()
def narrow(bracket: Bracket, look: Look, s: Step) -> bool:
    """Narrow a bracket to five nodes about the best one of a look, or leave it if it is outside.

    Returns whether it has new nodes to be judged. If it is nothing but rounding, or an instant, it
    is done.
    """
    read_look(bracket, look, s)
    seen, parts, best = bracket.seen, look.parts, 0
    for k in range(1, parts + 1):
        if bracket.sense * seen[k] > bracket.sense * seen[best]:
            best = k
    ends = look.spacing < INSTANT or shows_rounding(bracket, parts)
    bracket.rounds = MOST_ROUNDS if ends else bracket.rounds + 1
    if parts == AROUND:
        share = look.spacing / bracket.spacing
        bracket.narrowing = share * share
        if best in (0, LAST):
            bracket.narrowing = 0.0
            abscissa = (look.start + best * look.spacing - bracket.start) / bracket.spacing
            count(bracket, abscissa, seen[best], s)
            return False
    elif bracket.narrowing == 0.0 and bracket.rounds % AGAIN == 0:
        bracket.narrowing = FIRST
    kept = min(max(best - NODES // 2, 0), parts + 1 - NODES)
    for i in range(NODES):
        bracket.values[i] = seen[kept + i]
    bracket.best = best - kept
    bracket.start, bracket.spacing = look.start + kept * look.spacing, look.spacing
    return not ends
