"""Whether a channel's extreme at an end of a step is one, or something next to it surpasses it.

A force begins with a contact and ends with it: so do forces of joints, and accelerations. There
these have extremes, at instants that are known, and no polynomial near them.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.search.brackets import LAST, MOST_ROUNDS, Bracket
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import count
from jointplay.solver.kernels.loop.extremes.search.narrowing import PER_STEP
from jointplay.solver.kernels.loop.step import Step, channels_around

DISTANCES = (1e-4, 0.008, 0.06, 0.45)
"""Instants of a look at an end, in spacings from there. What begins at the end and turns a channel
that rises by a tenth of its range in a step hides at most 1e-6 of that before the nearest."""
SAME = 1e-9
"""Share of a step: instants closer than that are one."""


@inner_kernel()
def is_at_end(bracket: Bracket) -> bool:
    """Whether a bracket's best value is at an end of its step."""
    share = bracket.start + bracket.best * bracket.spacing
    at_begin = bracket.best == 0 and share <= SAME
    return bool(at_begin or (bracket.best == LAST and share >= 1.0 - SAME))


@inner_kernel()
def look_at_ends(waiting: int, s: Step) -> None:
    """Leave brackets whose best values are at ends of steps, where nothing next to it surpasses it.

    Those at the same end are looked at together, and one end of each of the two steps.
    """
    for bracket in s.brackets[:waiting]:
        bracket.at_end = int(bracket.rounds < MOST_ROUNDS and is_at_end(bracket))
    while place_at_ends(waiting, s):
        channels_around(s)
        for bracket in s.brackets[:waiting]:
            first = s.spare[s.at.theta, PER_STEP * bracket.step]
            if bracket.at_end and first == beside_end(0, bracket):
                bracket.at_end = 0
                look_at_end(bracket, s)


@inner_kernel()
def beside_end(i: int, bracket: Bracket) -> float:
    """Return where in its step the instant `i` of a look at a bracket's end is."""
    far = DISTANCES[i] * bracket.spacing
    return float(far if bracket.best == 0 else 1.0 - far)


@inner_kernel()
def place_at_ends(waiting: int, s: Step) -> bool:
    """Place instants at the end of the first bracket that is to be looked at in either step.

    Returns whether there is one.
    """
    placed = np.zeros(2, np.bool_)
    for bracket in s.brackets[:waiting]:
        if bracket.at_end and not placed[bracket.step]:
            placed[bracket.step] = True
            for i in range(PER_STEP):
                s.spare[s.at.theta, PER_STEP * bracket.step + i] = beside_end(i, bracket)
    return bool(placed[0] or placed[1])


@inner_kernel()
def look_at_end(bracket: Bracket, s: Step) -> None:
    """Leave a bracket if its channel only falls behind the end of the step, by the look there.

    If it rises and then falls, the bracket is narrowed to the end and the instant behind the best.
    """
    sense, best, spacing = bracket.sense, bracket.best, bracket.spacing
    away, column = (1 if best == 0 else -1), PER_STEP * bracket.step
    look = s.spare[s.at.channel + bracket.row, column : column + PER_STEP]
    rises, before = 0, bracket.values[best]
    for i in range(PER_STEP + 1):
        value = look[i] if i < PER_STEP else bracket.values[best + away]
        if i < PER_STEP:
            count(bracket, best + away * DISTANCES[i], value, s)
        if sense * value > sense * before:
            if rises < i:
                return
            rises += 1
        before = value
    if rises == 0:
        bracket.rounds = MOST_ROUNDS
    elif rises < PER_STEP:
        bracket.values[best + away] = look[rises]
        bracket.spacing = DISTANCES[rises] * spacing
        bracket.start += best * (spacing - bracket.spacing)
