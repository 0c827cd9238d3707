"""Special orbits between two of a branch, where functions of multipliers change their sign."""

from collections.abc import Callable
from dataclasses import dataclass

from jointplay.solver.continuation.location import Found, Piece, root
from jointplay.solver.continuation.multipliers import Complexes, multipliers_of

Test = Callable[[Complexes], float]
JUMP = 0.1
"""Share of the lesser value at the ends of a piece that a function has left where it jumps; where
it is smooth, and located, next to nothing is left."""


@dataclass(frozen=True)
class Special:
    """A special orbit between two of a branch."""

    label: str
    found: Found
    note: str = ""
    last: bool = False
    """Whether the branch ends there."""
    jumps: bool = False
    """Whether multipliers jump there, so that any number of them may cross the unit circle."""


def changes(piece: Piece, test: Test) -> bool:
    """Return whether a function of multipliers has another sign at the other end of a piece."""
    return (test(piece.first.multipliers) > 0.0) != (test(piece.last.multipliers) > 0.0)


def jumps(piece: Piece, test: Test, found: Found) -> bool:
    """Return whether such a function does not come near zero where its sign changes."""
    ends = (abs(test(one.multipliers)) for one in (piece.first, piece.last))
    return abs(test(found.orbit.multipliers)) > JUMP * min(ends)


def zero(piece: Piece, test: Test) -> Found:
    """Return where such a function is zero; see `root`."""
    return root(
        piece,
        lambda orbit: test(orbit.multipliers),
        lambda orbit: test(multipliers_of(orbit.coarser.monodromy)),
    )
