"""Special orbits of a branch between two that are near each other: what bifurcates or grazes."""

from collections.abc import Iterator
from dataclasses import replace

from jointplay.solver.continuation.codimension_two import beside
from jointplay.solver.continuation.location import NotLocated, Piece, change, root
from jointplay.solver.continuation.multipliers import (
    doubling,
    is_torus,
    passing_one,
    preserves_areas,
    torus,
    unstable,
)
from jointplay.solver.continuation.orbit import Orbit
from jointplay.solver.continuation.sign_changes import Special, changes, jumps, zero

MOST_GRAZINGS = 8
"""Impacts that may begin or end between two orbits; where more do, steps are shorter."""
MOST_STICKINGS = 4
"""Phases of friction that may begin or end between two orbits; others are not told."""
SHAKEN = 1e-6
"""Length along the branch within which that is one: a symmetric motion has two, apart by what the
steps of runs leave."""
CHANGES = {"LP": 1, "BP": 1, "PD": 1, "NS": 2, "GR": 0, "ST": 0}
"""By how many the unstable multipliers may change."""


def special_orbits(piece: Piece) -> list[Special]:
    """Return what lies between two orbits, in the order of the branch.

    NotLocated: it is there, and could not be located.
    """
    found = _beside(piece) if piece.curve.of else _every(piece)
    return sorted(found, key=lambda one: one.found.at)


def _beside(piece: Piece) -> Iterator[Special]:
    yield from beside(piece)
    if piece.curve.of != "GR":
        yield from _grazing(piece)


def explained(piece: Piece, specials: list[Special]) -> bool:
    """Return whether what was found accounts for the change of stability.

    Special orbits themselves have multipliers on the circle, which come to lie on any side.
    """
    if piece.curve.of:
        return True
    if any(one.jumps for one in specials):
        return True
    allowed = sum(CHANGES[one.label] for one in specials)
    first, last = (unstable(one.multipliers) for one in (piece.first, piece.last))
    excess = abs(last - first) - allowed
    return excess <= 0 or excess <= _uncertain(piece)


def _uncertain(piece: Piece) -> int:
    """Return how many multipliers at either end may be on either side of the unit circle."""
    return sum(
        unstable(one.multipliers, within=-one.slack) - unstable(one.multipliers, within=one.slack)
        for one in (piece.first, piece.last)
    )


def _neutral(piece: Piece) -> bool:
    """Return whether two multipliers have the product 1 at both ends, but for errors."""
    return all(preserves_areas(one.multipliers, one.slack) for one in (piece.first, piece.last))


def _every(piece: Piece) -> Iterator[Special]:
    first, last = piece.first, piece.last
    turned = piece.direction(first) * piece.direction(last) < 0.0
    if turned:
        found = root(piece, piece.direction, lambda one: piece.direction(one, coarser=True))
        yield Special("LP", found)
    grazes, jumped = piece.first.onsets != piece.last.onsets, False
    for label, test in (("BP", passing_one), ("PD", doubling), ("NS", torus)):
        if (label == "BP" and turned) or not changes(piece, test):
            continue
        if label == "NS" and _neutral(piece):
            continue
        found = zero(piece, test)
        if grazes and jumps(piece, test, found):
            jumped = True
        elif label != "NS" or is_torus(found.orbit.multipliers):
            yield Special(label, found)
    yield from (replace(one, jumps=jumped) for one in _grazing(piece))
    yield from _sticking(piece)


def _grazing(piece: Piece) -> Iterator[Special]:
    at, onsets, count = 0.0, piece.first.onsets, 0
    while onsets != piece.last.onsets:
        count += 1
        if count > MOST_GRAZINGS:
            raise NotLocated(f"more than {MOST_GRAZINGS} impacts begin or end")
        found = change(piece, _onsets, at)
        at = found.at
        behind = piece.last.onsets if at >= piece.length else piece.orbit(at).onsets
        yield Special("GR", found, _grazed(onsets, behind))
        onsets = behind


def _sticking(piece: Piece) -> Iterator[Special]:
    """Yield where phases of friction begin or end; no more of a piece in which that cannot be told.

    A branch does not depend on them, so that it goes on there. Phases of other impacts are others.
    """
    at, before, last = 0.0, piece.first.phases, piece.last.phases
    if piece.first.onsets != piece.last.onsets:
        return
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


def _grazed(before: int, behind: int) -> str:
    change = "begin" if behind > before else "end"
    what = f"an impact {change}s" if abs(behind - before) == 1 else f"impacts {change}"
    return f"{what}: {before} before, {behind} behind"


def _onsets(orbit: Orbit) -> int:
    return orbit.onsets
