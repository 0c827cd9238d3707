"""A continuation as a study: a point is a branch, its sections are the branch's orbits."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.runs.study.plan import Study

COUNTED = {
    "LP": "folds",
    "PD": "doublings",
    "NS": "tori",
    "BP": "branch_points",
    "GR": "grazings",
    "ST": "stickings",
}
"""Names of numbers of a branch, by the label of the special orbits that they count."""
OUTPUTS = {
    "orbits": ("1", "orbits of the branch, special ones counted"),
    "folds": ("1", "folds (LP)"),
    "doublings": ("1", "period doublings (PD)"),
    "tori": ("1", "Neimark-Sacker bifurcations (NS)"),
    "branch_points": ("1", "branch points (BP)"),
    "grazings": ("1", "grazings: an impact begins or ends (GR)"),
    "stickings": ("1", "phases of friction that begin or end (ST)"),
}
"""Unit and long name of what each branch has beside its orbits and accepted steps."""
SECTIONS = 256
"""Periods of motion in which several orbits are sought."""
TRIES = 8
"""Sections from which Newton's method starts at most, for each orbit that is asked for."""


@dataclass(frozen=True)
class Reach:
    """Bounds within which a branch is followed."""

    low: float
    high: float
    """Range of the parameter over which it is followed."""
    orbits: int
    """Most orbits in one direction, special ones not counted."""
    step: float
    """Largest, as a length along the branch: about a share of the range."""
    first: tuple[tuple[float, float], ...] = ()
    """Range of the parameter before it, of special orbits that are followed over a second one."""

    def inside(self, values: Sequence[float]) -> bool:
        """Return whether values lie in their ranges, and not at an end but for rounding."""
        return not any(True for _ in self.left(values))

    def left(self, values: Sequence[float]) -> Iterator[tuple[int, float]]:
        """Yield which values are not inside, and the end of the range next to each."""
        ranges = (*self.first, (self.low, self.high))
        for k, (value, (low, high)) in enumerate(zip(values, ranges, strict=True)):
            rounding = 8.0 * math.ulp(max(abs(low), abs(high)))
            if not low + rounding < value < high - rounding:
                yield k, low if value < 0.5 * (low + high) else high


@dataclass(frozen=True)
class Second:
    """Special orbits of the first branch that are followed over a second parameter."""

    start: float
    """Value of that parameter on the branches."""
    reach: Reach
    labels: tuple[str, ...]
    """Labels of the orbits that are followed."""
    curves: int
    """Most curves: so many points follow those of the branches."""


@dataclass(frozen=True, eq=False)
class ContinuationStudy(Study):
    """A study of branches, a point each, then of curves.

    The first branch, those behind its doublings, others through its branch points, and those of
    other orbits of the motion. Curves are of special orbits of the first branch, over a second
    parameter.
    """

    start: float
    """Value of the parameter at which the first branch begins."""
    reach: Reach
    doublings: int
    """Points that are branches behind a doubling of the point before."""
    orbits: int
    """Points that begin at an orbit of the motion: the first, and the last ones before curves."""
    second: Second | None

    @property
    def curves(self) -> int:
        """Points that are curves of special orbits."""
        return self.second.curves if self.second else 0

    def attributes(self) -> dict[str, Any]:
        """Return the labels of special orbits, as stores keep their positions."""
        return {"labels": dict(LABELS)}
