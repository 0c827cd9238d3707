"""Extent of a reproduction: the whole, or little of everything."""

from dataclasses import dataclass
from typing import Final

from jointplay.paper.variants import AS_PUBLISHED, CONSTANT, MOTIONS, SLIPS, VARIANTS, Slip, Variant


@dataclass(frozen=True)
class Size:
    """Extent of a reproduction. Periods are revolutions of the first driver.

    Parameters
    ----------
    early
        First and last period of the window soon after the start, as pictures usually show.
    late
        The same after long settling.
    settle, record
        Periods of the sections that indicators are computed from, before and in the record.
    members, tolerance
        Starts from which these are computed, and how exactly: at the standard tolerance exponents
        of the stiffest contacts are off by a third, or positive where neighbours converge.
    thinning
        Stride through the values of bifurcation diagrams.
    diagram
        Periods of a diagram, left out and recorded.
    variants
        Whose peaks and ranges are compared.
    motions
        Whose settled motion is looked at.
    drawn
        Slip velocities of the figures of responses.
    """

    early: tuple[int, int] = (2, 12)
    late: tuple[int, int] = (100, 200)
    settle: int = 100
    record: int = 300
    members: int = 8
    tolerance: float = 1e-8
    thinning: int = 1
    diagram: tuple[int, int] = (100, 50)
    variants: tuple[Variant, ...] = VARIANTS
    motions: tuple[Variant, ...] = MOTIONS
    drawn: tuple[Slip, ...] = SLIPS


FULL: Final = Size()
QUICK: Final = Size(
    early=(1, 3),
    late=(5, 10),
    settle=10,
    record=20,
    members=2,
    thinning=25,
    diagram=(5, 5),
    variants=tuple(Variant(CONSTANT, slip) for slip in SLIPS),
    motions=(Variant(CONSTANT, AS_PUBLISHED),),
    drawn=(AS_PUBLISHED,),
)
