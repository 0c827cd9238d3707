"""Outcome of a calibration: the best candidate, the spread around it, and every target's value."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.calibration.search import Found
from jointplay.solver.calibration.spread import EquallyGood
from jointplay.solver.version import SOLVER_VERSION

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
AT_BOUND = 0.02
"""Share of a parameter's range: a spread that comes so close to a bound has no end there."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """Best parameters, and those that fit equally well.

    Attributes
    ----------
    best : (parameters,) float
        In the unit of each, rounded to a few digits.
    cost : float
        Of the best as rounded: root mean square of the misses in tolerances.
    values : (targets,) float
        What the best gives; every target, fitted or only shown.
    lowest, highest : (targets,) float
        Of what fits equally well; NaN where a target is only shown and its run failed.
    roughness : (targets,) float
        How far values change, in tolerances, when parameters move by a ten-thousandth of their
        range: what cannot be fitted, since neighbours differ by it.
    members : (n, parameters) float
        What fits equally well, in the unit of each parameter; a sample, evenly spread.
    """

    calibration: Calibration
    found: Found
    good: EquallyGood
    best: Floats
    cost: float
    values: Floats
    lowest: Floats
    highest: Floats
    roughness: Floats
    members: Floats

    @property
    def misses(self) -> Floats:
        """Misses of the targets, in tolerances, (targets,)."""
        return self.calibration.goals.misses(self.values)

    def quantiles(self) -> Floats:
        """Return (quantiles, parameters) of what fits equally well."""
        space = self.calibration.space
        return space.values(np.quantile(self.good.members, QUANTILES, axis=0))

    def correlation(self) -> Floats:
        """Return (parameters, parameters): which parameters make up for one another."""
        members = self.good.members
        spans = members.std(axis=0)
        if len(members) < 2 or not (spans > 0.0).all():
            return np.eye(members.shape[1])
        return np.atleast_2d(np.corrcoef(members, rowvar=False))

    def open_ends(self, parameter: int) -> list[str]:
        """Return the bounds that the spread of a parameter runs into."""
        column = self.good.members[:, parameter]
        ends = {"minimum": column.min() <= AT_BOUND, "maximum": column.max() >= 1.0 - AT_BOUND}
        return [end for end, reached in ends.items() if reached]

    def document(self) -> dict[str, Any]:
        """Return everything as JSON; the same calibration gives the same."""
        calibration = self.calibration
        return {
            "calibration": calibration.document,
            "digest": calibration.digest,
            "solver": SOLVER_VERSION,
            "cost": self.cost,
            "equally_good_cost": self.good.limit,
            "parameters": self._parameters(),
            "correlation": {
                "parameters": list(calibration.space.names),
                "matrix": np.round(self.correlation(), 3).tolist(),
            },
            "targets": self._targets(),
            "members": {
                "parameters": list(calibration.space.names),
                "values": self.members.tolist(),
            },
            "search": {
                "generations": self.found.generations,
                "settled": self.found.settled,
                "candidates": len(self.found.costs),
                "best_costs": [_number(cost) for cost in self.found.best_costs()],
                "failed": int(np.isinf(self.found.costs).sum()),
                "spread_candidates": self.good.tried,
                "spread_accepted": round(self.good.accepted, 4),
                "spread_settled": self.good.settled,
            },
        }

    def _parameters(self) -> list[dict[str, Any]]:
        space = self.calibration.space
        quantiles = self.quantiles()
        ends = space.values(
            np.stack([self.good.members.min(axis=0), self.good.members.max(axis=0)])
        )
        return [
            {
                "name": name,
                "unit": self.calibration.scene.parameters[name].unit,
                "best": float(self.best[k]),
                "quantiles": {
                    f"{q:g}": float(at) for q, at in zip(QUANTILES, quantiles[:, k], strict=True)
                },
                "lowest": float(min(ends[0, k], self.best[k])),
                "highest": float(max(ends[1, k], self.best[k])),
                "open_ends": self.open_ends(k),
            }
            for k, name in enumerate(space.names)
        ]

    def _targets(self) -> list[dict[str, Any]]:
        shown = [
            (case, target, channel)
            for case in self.calibration.cases
            for target, channel in zip(case.targets, case.channels, strict=True)
        ]
        numbers = {
            "fitted": self.values,
            "miss": self.misses,
            "lowest": self.lowest,
            "highest": self.highest,
            "roughness": self.roughness,
        }
        return [
            {
                "case": case.name,
                "channel": target.channel,
                "statistic": target.statistic,
                "from": target.start,
                "to": target.stop,
                "unit": "s" if target.statistic.endswith("_time") else channel.unit,
                "value": target.value,
                "between": target.between,
                "tolerance": float(self.calibration.goals.tolerance[k]),
                "weight": target.weight,
                **{name: _number(column[k]) for name, column in numbers.items()},
            }
            for k, (case, target, channel) in enumerate(shown)
        ]


def _number(value: np.float64) -> float | None:
    """Return a value for JSON, which has no NaN."""
    return float(value) if np.isfinite(value) else None
