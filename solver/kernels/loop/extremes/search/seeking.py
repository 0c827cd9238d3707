"""Seeks extremes of channels in brackets of a step, more closely until they are sharp.

Brackets of a channel are narrowed one after the other: what one finds decides whether the next one
matters. So the extremes of a channel do not depend on which others are sought.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.search.brackets import MOST_ROUNDS, SHARP, Bracket
from jointplay.solver.kernels.loop.extremes.search.extreme import LEFT_OUT, extreme, slope_left_out
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import (
    count,
    count_best,
    extreme_so_far,
    spread,
)
from jointplay.solver.kernels.loop.extremes.search.narrowing import (
    PER_STEP,
    closer,
    narrow,
    place_closer,
)
from jointplay.solver.kernels.loop.extremes.search.step_ends import is_at_end, look_at_ends
from jointplay.solver.kernels.loop.step import Step, channels_around

FORETOLD = 5e-9
"""The same, of the bound on what a quartic foretells that is not evaluated there."""
LEAST_OFF = 0.1
"""Share of the bound that a quartic's error is taken to be where it happens to be small."""
ULP = 2.0**-52
"""Share of a value that it is rounded by at least."""
ENOUGH_AT_END = 3
"""Rounds after which a best value at the end of a step counts as it is."""


@inner_kernel(borrows=True)
def is_done(bracket: Bracket, sharp: float, s: Step) -> bool:
    """Look where a bracket's extreme is, and let it count if it is beyond that so far and sharp.

    Returns whether nothing is left to do: otherwise it may be beyond, and is not sharp. `sharp` :
    share of the channel's range up to now by which it may be off.
    """
    sense, so_far = bracket.sense, extreme_so_far(bracket.row, bracket.sense, s)
    abscissa, value, error, bent = extreme(
        bracket.values, bracket.best, sense, so_far, bracket.spacing
    )
    if not sense * value + error > sense * so_far:
        return True
    bracket.abscissa, bracket.value, bracket.error, bracket.bent = abscissa, value, error, bent
    if error > max(sharp * spread(bracket.row, value, s), ULP * abs(value)):
        return False
    count(bracket, float(bracket.best) if bent == 0.0 else abscissa, value, s)
    return True


@inner_kernel(forceinline=True, borrows=True)
def is_done_by(value: float, bracket: Bracket, s: Step) -> bool:
    """Let the value at a bracket's extreme count. Returns whether it is sharp.

    What is beyond the value found is the square of the slope there by twice the second derivative.
    """
    count(bracket, bracket.abscissa, value, s)
    slope = slope_left_out(bracket.abscissa, abs(value - bracket.value))
    slope = max(slope, LEFT_OUT * LEAST_OFF * bracket.error)
    return bool(0.5 * slope * slope <= SHARP * spread(bracket.row, value, s) * bracket.bent)


@inner_kernel(borrows=True)
def seek(waiting: int, s: Step) -> None:
    """Evaluate the channels of brackets where their extremes seem to be, many at once.

    Mostly that makes them sharp; the others are narrowed until they are, or do not matter.
    """
    if look_where_foretold(waiting, s) > 0:
        look_at_ends(waiting, s)
        narrow_all(waiting, s)


@inner_kernel(borrows=True)
def look_where_foretold(waiting: int, s: Step) -> int:
    """Evaluate the channels of brackets where their extremes seem to be.

    Returns how many are not sharp.
    """
    k, unsharp = 0, 0
    while k < waiting:
        first, early, late = k, 0, PER_STEP
        while k < waiting and early < PER_STEP and late < INSTANTS:
            bracket = s.brackets[k]
            k += 1
            bracket.column = -1
            at_node = bracket.abscissa == np.floor(bracket.abscissa)
            if at_node or bracket.rounds == MOST_ROUNDS:
                continue
            bracket.column = late if bracket.step else early
            early, late = (early, late + 1) if bracket.step else (early + 1, late)
            share = bracket.start + bracket.abscissa * bracket.spacing
            s.spare[s.at.theta, bracket.column] = share
        if early > 0 or late > PER_STEP:
            channels_around(s)
        for bracket in s.brackets[first:k]:
            if bracket.rounds == MOST_ROUNDS:
                continue
            value = bracket.values[int(bracket.abscissa)]
            if bracket.column >= 0:
                value = s.spare[s.at.channel + bracket.row, bracket.column]
            if is_done_by(value, bracket, s):
                bracket.rounds = MOST_ROUNDS
            else:
                count_best(bracket, s)
                unsharp += 1
    return unsharp


@inner_kernel()
def narrow_all(waiting: int, s: Step) -> None:
    """Narrow brackets that are not done, each together with those of its step that have its nodes.

    Many channels have a kink where a law has one: those of the same nodes are narrowed at once.
    """
    for k in range(waiting):
        first = s.brackets[k]
        while first.rounds < MOST_ROUNDS:
            step, look = first.step, closer(first)
            place_closer(look, PER_STEP * step, s)
            channels_around(s)
            row, before_is_open = -1, False
            for j in range(k, waiting):
                bracket = s.brackets[j]
                has_turn = bracket.row != row or not before_is_open
                row, before_is_open = bracket.row, bracket.rounds < MOST_ROUNDS or not has_turn
                if not has_turn or bracket.rounds == MOST_ROUNDS or bracket.step != step:
                    continue
                if j == k or look == closer(bracket):
                    has_new_nodes = narrow(bracket, look, s)
                    # beside an end there may be a jump: no looking closer would tell more
                    rests = bracket.rounds >= ENOUGH_AT_END and is_at_end(bracket)
                    if has_new_nodes and (is_done(bracket, FORETOLD, s) or rests):
                        bracket.rounds = MOST_ROUNDS
                    if bracket.rounds >= MOST_ROUNDS:
                        count_best(bracket, s)
