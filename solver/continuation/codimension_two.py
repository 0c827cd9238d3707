"""Special orbits on a curve of special orbits: those of codimension two.

Kuznetsov 2004, Elements of Applied Bifurcation Theory, 3rd ed., chapter 9.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.location import NotLocated, Piece, root
from jointplay.solver.continuation.multipliers import (
    doubling,
    is_torus,
    neutral_pair,
    passing_one,
    torus,
)
from jointplay.solver.continuation.orbit import Orbit
from jointplay.solver.continuation.sign_changes import Special, Test, changes, zero

RESONANCES = {"LP": "R1", "PD": "R2"}
"""Where a second multiplier comes to that of a fold, or of a doubling."""
COSINES = {"R1": 1.0, "R2": -1.0, "R3": -0.5, "R4": 0.0}
"""Cosine of the angle of a pair on the unit circle at its strong resonances."""
ENDS = {"R1": "1", "R2": "-1"}
"""Where pairs on the unit circle meet; beyond, both multipliers are real."""
RESTING = 1e-2
"""Share of the tangent that both parameters may have left where they turn at once."""
AROUND = 0.015
"""Length along a curve on both sides of a generalised doubling by which it is told from noise."""
KNOWN = 0.3
"""Noise of its coefficient there, in how much that changes."""
ROUND = 0.1
"""Share of that error below which it is not sought more closely."""
OTHERS: dict[str, Test] = {"PD": doubling, "LP": passing_one, "NS": torus}


def beside(piece: Piece) -> Iterator[Special]:
    """Yield what happens between two orbits of a curve, besides what the curve is of."""
    if piece.curve.of == "NS":
        yield from _of_pairs(piece)
        return
    if piece.curve.of == "LP":
        yield from _cusps(piece)
    if piece.curve.of == "PD":
        yield from _generalised_doublings(piece)
    yield from _of_one(piece)


def _cusps(piece: Piece) -> Iterator[Special]:
    """Yield where both parameters turn at once, and come to rest by differences of either scale.

    A run that errs by more than others spoils those of one scale alone.
    """
    first, last = map(piece.directions, (piece.first, piece.last))
    if not float(np.sum(first * last)) < 0.0:
        return
    for coarser in (False, True):
        tests = (_along(piece, last - first, one) for one in (coarser, not coarser))
        found = root(piece, *tests)
        rest = np.abs(piece.directions(found.orbit, coarser=coarser)).max()
        if rest < RESTING * np.abs(last - first).max():
            yield Special("CP", found)
            return


def _along(piece: Piece, way: Floats, coarser: bool) -> Callable[[Orbit], float]:
    """Return the parameters' share of the tangent along a way, by differences of one scale."""
    return lambda orbit: float(np.sum(way * piece.directions(orbit, coarser=coarser)))


def _generalised_doublings(piece: Piece) -> Iterator[Special]:
    """Yield where orbits of twice the period change from stable ones to unstable ones, or back.

    Not where their coefficient has a pole, as where another multiplier is 1, and only where it is
    known beside how it changes: noise could change its sign anywhere. A curve does not depend on
    it, and so goes on where it cannot be told.
    """
    first, last = piece.first.criticality[0], piece.last.criticality[0]
    if not first * last < 0.0:
        return
    middle = piece.length * first / (first - last)
    try:
        around = [piece.orbit(middle + way * AROUND).criticality for way in (-1.0, 0.0, 1.0)]
        change = abs(around[2][0] - around[0][0])
        if not _noise(around) < KNOWN * change:
            return
        found = root(piece, partial(_rounded, piece), lambda orbit: orbit.criticality[1])
    except NotLocated:
        return
    if abs(found.orbit.criticality[0]) < KNOWN * change:
        one, other = ("soft", "hard") if first > last else ("hard", "soft")
        note = f"period doubling is {one} on the side of the start, {other} beyond"
        yield Special("GPD", found, note)


def _noise(around: Sequence[tuple[float, float]]) -> float:
    """Return by how much three coefficients in a row, with their errors, scatter.

    What distances leave of both is smooth along a curve, however much it is.
    """
    (first, _), (middle, _), (last, _) = around
    left = [error for _, error in around]
    return abs(first - 2.0 * middle + last) + max(left) - min(left)


def _rounded(piece: Piece, orbit: Orbit) -> float:
    """Return the cubic coefficient of a doubling; between two orbits 0 where noise begins to rule.

    NotLocated: it is not known.
    """
    cubic, error = orbit.criticality
    if math.isnan(cubic):
        raise NotLocated("a run beside the orbit fails")
    inside = orbit is not piece.first and orbit is not piece.last
    return 0.0 if inside and abs(cubic) < ROUND * error else cubic


def _of_one(piece: Piece) -> Iterator[Special]:
    """Yield what other multipliers do while one is 1 or -1."""
    of = piece.curve.of
    for label, test in OTHERS.items():
        if label == of or not changes(piece, test):
            continue
        # at a resonance the two multipliers are one but for rounding, a complex pair perhaps
        turning = is_torus(piece.first.multipliers) and is_torus(piece.last.multipliers)
        named = label if label != "NS" or turning else RESONANCES.get(of)
        if named is not None:
            yield Special(named, zero(piece, test))


def _of_pairs(piece: Piece) -> Iterator[Special]:
    """Yield strong resonances of a pair on the unit circle, and what other multipliers do.

    Where the pair meets, the curve ends: beyond, the product of two real multipliers is 1.
    """
    for label, cosine in COSINES.items():
        test = _turned(cosine)
        if changes(piece, test):
            at = ENDS.get(label)
            note = f"both multipliers meet at {at}, and are real beyond: end of the curve"
            yield Special(label, zero(piece, test), note if at else "", last=at is not None)
    for label, test in OTHERS.items():
        if changes(piece, _of_others(test)):
            yield Special(label, zero(piece, _of_others(test)))


def _turned(cosine: float) -> Test:
    """Return how far the cosine of a pair's angle is from another."""
    return lambda multipliers: neutral_pair(multipliers)[0] - cosine


def _of_others(test: Test) -> Test:
    """Return a test of all multipliers but the pair."""
    return lambda multipliers: test(neutral_pair(multipliers)[1])
