"""Functions of an angle that repeat after a turn, which documents give to seven digits."""

import math

from jointplay.solver.laws.function import Function

TURN = 2.0 * math.pi
NEARLY = 1e-6
"""Mismatch within which knots that repeat are meant to do so after a turn: 2 pi to seven digits."""
WHOLE = 1e-9
"""Mismatch within which a turn is a whole number of a function's periods."""


def repeats_every_turn(function: Function) -> bool:
    """Return whether a function of an angle, rad, is what it was after every turn."""
    if function.is_constant:
        return True
    periods = TURN / function.period
    return round(periods) > 0 and abs(periods - round(periods)) <= WHOLE


def whole_turn(function: Function) -> Function:
    """Return a function of an angle whose last knot ends a turn, or an equal share, to rounding.

    One whose knots do so within `NEARLY` has the last one moved there.
    """
    knots = getattr(function, "knots", None)
    if not knots or getattr(function, "outside", "") != "periodic" or not knots[-1] > knots[0]:
        return function
    share = TURN / max(round(TURN / (knots[-1] - knots[0])), 1)
    if abs(knots[-1] - knots[0] - share) > NEARLY * share:
        return function
    moved = function.model_copy(update={"knots": [*knots[:-1], knots[0] + share]})
    return function if any(rule.broken(moved) for rule in function.rules) else moved
