"""Special orbits of a branch between two that are near each other: what bifurcates or grazes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

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
CHANGES = {"LP": 1, "BP": 1, "PD": 1, "NS": 2, "GR": 0}
"""By how many the unstable multipliers may change."""


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
    return sorted(_every(piece), key=lambda one: one.found.at)


def explained(piece: Piece, specials: list[Special]) -> bool:
    """Return whether what was found accounts for the change of stability."""
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
        if (test(first.multipliers) > 0.0) == (test(last.multipliers) > 0.0):
            continue
        if label == "BP" and turned:
            continue
        found = root(
            piece,
            partial(_tested, test),
            partial(_tested_coarser, test),
        )
        if label != "NS" or is_torus(found.orbit.multipliers):
            yield Special(label, found)
    yield from _grazing(piece)


def _tested(test: Test, orbit: Orbit) -> float:
    return test(orbit.multipliers)


def _tested_coarser(test: Test, orbit: Orbit) -> float:
    return test(multipliers_of(orbit.coarser.jacobian))


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


def _onsets(orbit: Orbit) -> int:
    return orbit.onsets
