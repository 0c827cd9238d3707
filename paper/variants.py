"""Readings of the publication where it does not print what is needed, and how much is computed."""

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True)
class Law:
    """A choice of the contact stiffness: `parameters` are set in the scene, readers see `label`."""

    name: str
    label: str
    parameters: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Slip:
    """A choice of the slip velocity that friction sees, as the scene's parameter names it."""

    name: str
    label: str


@dataclass(frozen=True)
class Variant:
    """One stiffness and one slip velocity."""

    law: Law
    slip: Slip

    @property
    def name(self) -> str:
        """Short name for folders."""
        return f"{self.law.name}-{self.slip.name}"

    @property
    def label(self) -> str:
        """Name for readers."""
        return f"{self.law.label}, {self.slip.label}"

    @property
    def parameters(self) -> dict[str, float | str]:
        """Parameters that are set in the scene."""
        return {"slip_velocity": self.slip.name, **dict(self.law.parameters)}

    @property
    def structure(self) -> tuple[str, float]:
        """Choices that kernels depend on."""
        return self.slip.name, dict(self.law.parameters).get("exponent", 1.5)


EQUATION_9: Final = Law("eq9", "K by eq. 9", ())
CONSTANT: Final = Law("k5e9", "K = 5·10⁹ N/m¹·⁵", (("stiffness", 5e9),))
"""Does not depend on the clearance; comes closest to the printed peaks of first impacts."""
SOFT: Final = Law("k1.6e8", "K = 1.6·10⁸ N/m¹·¹⁵", (("stiffness", 1.6e8), ("exponent", 1.15)))
"""Closer to a line contact; comes closest to the printed ranges."""
MATERIAL: Final = Slip("material", "slip of the material")
AS_PUBLISHED: Final = Slip("as-published", "slip as published")
SLIPS: Final = (MATERIAL, AS_PUBLISHED)
MOTIONS: Final = tuple(Variant(law, slip) for law in (CONSTANT, EQUATION_9) for slip in SLIPS)
"""Those whose settled motion is looked at."""
VARIANTS: Final = (*MOTIONS, Variant(SOFT, AS_PUBLISHED))
"""Those whose peaks and ranges are compared."""


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
    tolerance=1e-6,
    thinning=50,
    diagram=(5, 5),
    variants=tuple(Variant(CONSTANT, slip) for slip in SLIPS),
    motions=(Variant(CONSTANT, AS_PUBLISHED),),
    drawn=(AS_PUBLISHED,),
)
