"""A continuation as a study: a point is a branch, its sections are the branch's orbits."""

import math
from dataclasses import dataclass
from typing import Any

from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.runs.study.plan import Study

COUNTED = {"LP": "folds", "PD": "doublings", "NS": "tori", "BP": "branch_points", "GR": "grazings"}
"""Names of numbers of a branch, by the label of the special orbits that they count."""
OUTPUTS = {
    "orbits": ("1", "orbits of the branch, special ones counted"),
    "folds": ("1", "folds (LP)"),
    "doublings": ("1", "period doublings (PD)"),
    "tori": ("1", "Neimark-Sacker bifurcations (NS)"),
    "branch_points": ("1", "branch points (BP)"),
    "grazings": ("1", "grazings: an impact begins or ends (GR)"),
}
"""Unit and long name of what each branch has beside its orbits and accepted steps."""


@dataclass(frozen=True)
class Reach:
    """Bounds within which a branch is followed."""

    low: float
    high: float
    """Range of the parameter."""
    orbits: int
    """Most orbits in one direction, special ones not counted."""
    step: float
    """Largest, as a length along the branch: about a share of the range."""

    def inside(self, value: float) -> bool:
        """Return whether a value lies in the range, and not at an end but for rounding."""
        rounding = 8.0 * math.ulp(max(abs(self.low), abs(self.high)))
        return self.low + rounding < value < self.high - rounding

    def end(self, beyond: float) -> float:
        """Return the end of the range next to a value that is not inside."""
        return self.low if beyond < 0.5 * (self.low + self.high) else self.high


@dataclass(frozen=True, eq=False)
class ContinuationStudy(Study):
    """A study whose first point is the branch, and the others those behind its doublings."""

    start: float
    """Value of the parameter at which the first branch begins."""
    reach: Reach

    def attributes(self) -> dict[str, Any]:
        """Return the labels of special orbits, as stores keep their positions."""
        return {"labels": dict(LABELS)}
