"""Special orbits of a branch between two that are near each other: what bifurcates or grazes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.location import Found, NotLocated, Piece, change, root
from jointplay.solver.continuation.multipliers import (
    Complexes,
    doubling,
    is_torus,
    multipliers_of,
    passing_one,
    torus,
    unstable,
)
from jointplay.solver.continuation.orbit import Orbit

Test = Callable[[Complexes], float]

MOST_GRAZINGS = 8
"""Impacts that may begin or end between two orbits; where more do, steps are shorter."""
MOST_STICKINGS = 4
"""Phases of friction that may begin or end between two orbits; others are not told."""
SHAKEN = 1e-6
"""Length along the branch within which that is one: a symmetric motion has two, apart by what the
steps of runs leave."""
CHANGES = {"LP": 1, "BP": 1, "PD": 1, "NS": 2, "GR": 0, "ST": 0}
"""By how many the unstable multipliers may change."""
RESONANCES = {"LP": "R1", "PD": "R2"}
"""Where a second multiplier comes to that of a fold, or of a doubling."""
RESTING = 1e-2
"""Share of the tangent that both parameters may have left where they turn at once."""


@dataclass(frozen=True)
class Special:
    """A special orbit between two of a branch."""

    label: str
    found: Found
    note: str = ""


def special_orbits(piece: Piece) -> list[Special]:
    """Return what lies between two orbits, in the order of the branch.

    NotLocated: it is there, and could not be located.
    """
    found = _beside(piece) if piece.curve.of else _every(piece)
    return sorted(found, key=lambda one: one.found.at)


def explained(piece: Piece, specials: list[Special]) -> bool:
    """Return whether what was found accounts for the change of stability.

    Special orbits themselves have multipliers on the circle, which come to lie on any side.
    """
    if piece.curve.of:
        return True
    counts = [unstable(orbit.multipliers) for orbit in (piece.first, piece.last)]
    allowed = sum(CHANGES[one.label] for one in specials)
    return abs(counts[1] - counts[0]) <= allowed


def _every(piece: Piece) -> Iterator[Special]:
    first, last = piece.first, piece.last
    turned = piece.direction(first) * piece.direction(last) < 0.0
    if turned:
        found = root(piece, piece.direction, lambda one: piece.direction(one, coarser=True))
        yield Special("LP", found)
    for label, test in (("BP", passing_one), ("PD", doubling), ("NS", torus)):
        if (label == "BP" and turned) or not _changes(piece, test):
            continue
        found = _root(piece, test)
        if label != "NS" or is_torus(found.orbit.multipliers):
            yield Special(label, found)
    yield from _grazing(piece)
    yield from _sticking(piece)


def _beside(piece: Piece) -> Iterator[Special]:
    """Yield what happens on a curve of special orbits besides: orbits of codimension two.

    Where the curve of folds has a cusp, both parameters turn at once, and come to rest.
    """
    of, (first, last) = piece.curve.of, map(piece.directions, (piece.first, piece.last))
    if of == "LP" and float(np.sum(first * last)) < 0.0:
        found = root(piece, *_along(piece, last - first))
        rest = np.abs(piece.directions(found.orbit)).max()
        if rest < RESTING * np.abs(last - first).max():
            yield Special("CP", found)
    others = {"PD": doubling, "LP": passing_one, "NS": torus}
    for label, test in others.items():
        if label == of or not _changes(piece, test):
            continue
        # at a resonance the two multipliers are one but for rounding, a complex pair perhaps
        turning = is_torus(piece.first.multipliers) and is_torus(piece.last.multipliers)
        named = label if label != "NS" or turning else RESONANCES.get(of)
        if named is not None:
            yield Special(named, _root(piece, test))
    if of != "GR":
        yield from _grazing(piece)


def _along(piece: Piece, way: Floats) -> tuple[Callable[[Orbit], float], Callable[[Orbit], float]]:
    """Return the parameters' share of the tangent along a way, by both differences."""
    return (
        lambda orbit: float(np.sum(way * piece.directions(orbit))),
        lambda orbit: float(np.sum(way * piece.directions(orbit, coarser=True))),
    )


def _changes(piece: Piece, test: Test) -> bool:
    return (test(piece.first.multipliers) > 0.0) != (test(piece.last.multipliers) > 0.0)


def _root(piece: Piece, test: Test) -> Found:
    return root(piece, partial(_tested, test), partial(_tested_coarser, test))


def _tested(test: Test, orbit: Orbit) -> float:
    return test(orbit.multipliers)


def _tested_coarser(test: Test, orbit: Orbit) -> float:
    return test(multipliers_of(orbit.coarser.monodromy))


def _grazing(piece: Piece) -> Iterator[Special]:
    at, onsets, count = 0.0, piece.first.onsets, 0
    while onsets != piece.last.onsets:
        count += 1
        if count > MOST_GRAZINGS:
            raise NotLocated(f"more than {MOST_GRAZINGS} impacts begin or end")
        found = change(piece, _onsets, at)
        at = found.at
        behind = piece.last.onsets if at >= piece.length else piece.orbit(at).onsets
        gained = "begins" if behind > onsets else "ends"
        yield Special("GR", found, f"an impact {gained}: {onsets} before, {behind} behind")
        onsets = behind


def _sticking(piece: Piece) -> Iterator[Special]:
    """Yield where phases of friction begin or end; no more of a piece in which that cannot be told.

    A branch does not depend on them, so that it goes on there.
    """
    at, before, last = 0.0, piece.first.phases, piece.last.phases
    for _ in range(MOST_STICKINGS):
        if before == last or len(before) != len(last):
            return
        try:
            found = change(piece, _phases, at)
            at = min(found.at + SHAKEN, piece.length)
            behind = piece.last if at == piece.length else piece.orbit(at)
        except NotLocated:
            return
        if behind.phases == before:  # they have come back
            continue
        values = zip(found.orbit.values, behind.values, strict=True)
        found = replace(found, bounds=tuple(abs(b - a) for a, b in values))
        note = f"friction {_told(before)} before, {_told(behind.phases)} behind"
        yield Special("ST", found, note)
        before = behind.phases


def _phases(orbit: Orbit) -> tuple[int, ...]:
    return orbit.phases


def _told(phases: tuple[int, ...]) -> str:
    return f"sticks {sum(phases[::2])} and slides {sum(phases[1::2])} times a period"


def _onsets(orbit: Orbit) -> int:
    return orbit.onsets
