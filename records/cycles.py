"""Cycles of sections that points end on, as numbers by which they are told apart.

The mean and the spread of every state over a cycle are the same wherever on it a record ends, as
are the covariances of states, by which mirror images differ whose means are zero.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Flags, Floats

MEAN: Final = "cycle_mean."
SPREAD: Final = "cycle_spread."
COVARIANCE: Final = "cycle_covariance."
"""Beginnings of names of statistics: of each state, its mean over a cycle and its spread; of each
but the first, its covariance with those before."""
INDEPENDENT: Final = "independent_sections"
"""Name of a statistic of motions that do not recur: of so many independent sections means and
spreads would scatter as they do."""
SAME: Final = 2e-3
"""Share of what counts as one in a state, or of the range of all attractors if that is more: closer
attractors are one. It is twice what sections may differ by that recur."""


@dataclass(frozen=True)
class Cycles:
    """Numbers by which cycles are told apart, of each point that ends on one."""

    features: Floats
    """(points, 3 states - 1) means, spreads and covariances."""
    scales: Floats
    """(columns,) what counts as one."""
    angles: Flags
    """(columns,) of which whole turns do not count."""
    independent: Floats
    """(points,) independent sections of motions that do not recur."""

    def of(self, points: Any) -> "Cycles":
        """Return those of some points."""
        return Cycles(self.features[points], self.scales, self.angles, self.independent[points])

    def apart(self, features: Floats, one: Floats) -> Floats:
        """Return by how much features differ from one, but for whole turns of angles."""
        found = features - one
        return np.asarray(found - 2.0 * np.pi * np.round(found / (2.0 * np.pi)) * self.angles)

    def ranges(self) -> Floats:
        """Return the range of each column, at least its scale, of angles at most half a turn."""
        found = np.zeros_like(self.scales)
        if len(self.features):
            found = np.nanmax(self.features, axis=0) - np.nanmin(self.features, axis=0)
        found = np.where(self.angles, np.minimum(found, np.pi), found)
        return np.asarray(np.maximum(self.scales, found), np.float64)

    def scatter(self) -> Floats:
        """Return (points, columns) standard errors; of covariances nothing is known."""
        count = (self.features.shape[1] + 1) // 3
        spread = self.features[:, count : 2 * count]
        errors = spread / np.sqrt(self.independent)[:, None]
        turning = self.angles[: spread.shape[1]]
        # the direction of a mean of unit vectors whose length is 1 - spread^2 / 2
        length = np.where(turning, np.maximum(1.0 - 0.5 * spread**2, 1e-3), 1.0)
        unknown = np.full_like(errors[:, 1:], np.inf)
        found = np.concatenate([errors / length, errors, unknown], axis=1)
        return np.asarray(
            np.maximum(np.nan_to_num(found, nan=np.inf, posinf=np.inf), self.scales * SAME)
        )


def cycles_of(states: Mapping[str, Any], numbers: Mapping[str, Floats], points: int) -> Cycles:
    """Return the cycles of points.

    Parameters
    ----------
    states
        Of a study that compares them: `scales`, what counts as one in each state, and `angles`.
    numbers
        (points,) arrays by the names of statistics; of those that are missing nothing is known.
        Studies of earlier versions have no covariances.
    """
    names = list(states["scales"])
    scales = np.array([states["scales"][name] for name in names])
    angles = np.array([name in states["angles"] for name in names])
    missing = np.full(points, np.nan)
    columns = [numbers.get(f"{kind}{name}", missing) for kind in (MEAN, SPREAD) for name in names]
    columns += [numbers.get(f"{COVARIANCE}{name}", np.zeros(points)) for name in names[1:]]
    return Cycles(
        np.stack(columns, axis=1),
        np.concatenate([scales, scales, scales[1:]]),
        np.concatenate([angles, np.zeros(2 * len(names) - 1, np.bool_)]),
        numbers.get(INDEPENDENT, missing),
    )
