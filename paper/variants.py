"""Readings of the publication where it does not print what is needed: variants of one model."""

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
