"""Special orbits between two of a branch, where functions of multipliers change their sign."""

from collections.abc import Callable
from dataclasses import dataclass

from jointplay.solver.continuation.location import Found, Piece, root
from jointplay.solver.continuation.multipliers import Complexes, multipliers_of

Test = Callable[[Complexes], float]


@dataclass(frozen=True)
class Special:
    """A special orbit between two of a branch."""

    label: str
    found: Found
    note: str = ""
    last: bool = False
    """Whether the branch ends there."""


def changes(piece: Piece, test: Test) -> bool:
    """Return whether a function of multipliers has another sign at the other end of a piece."""
    return (test(piece.first.multipliers) > 0.0) != (test(piece.last.multipliers) > 0.0)


def zero(piece: Piece, test: Test) -> Found:
    """Return where such a function is zero; see `root`."""
    return root(
        piece,
        lambda orbit: test(orbit.multipliers),
        lambda orbit: test(multipliers_of(orbit.coarser.monodromy)),
    )
