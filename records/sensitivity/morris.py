"""Morris' design: elementary effects of one parameter after the other."""

from typing import ClassVar

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.design import Design, Measure

LEVELS = 4
"""Values of each parameter: the quantiles of the middles of as many equal probabilities."""
STEP = 0.5
"""Probability that a parameter moves by."""


class Morris(Design):
    """Rows in which each parameter moves once, in an order that is drawn.

    An elementary effect is what the output gains per unit of a parameter's probability.

    Source: Morris 1991, Technometrics 33:161; the mean magnitude by Campolongo et al. 2007.
    """

    measures: ClassVar = {
        "mean_magnitude": Measure("mean magnitude of the elementary effects", True),
        "mean_effect": Measure("mean of the elementary effects", True),
        "spread": Measure("standard deviation of the elementary effects", True),
    }

    def width(self, parameters: int) -> int:
        """Return the points of a row."""
        return parameters + 1

    def drawn(self, parameters: int) -> tuple[int, ...]:
        """Return none: a few values of each parameter are no sample of its distribution."""
        return ()

    def moments(self, values: Floats, outputs: Floats) -> Floats:
        """Return effects, their magnitudes and squares, of each parameter, and n / (n - 1)."""
        moved = np.sign(np.diff(values, axis=1))
        gained = np.diff(outputs, axis=1)
        effects = (moved * gained[:, :, None]).sum(axis=1) / STEP
        rows = len(values)
        unbiased = np.full((rows, 1), rows / max(rows - 1, 1))
        return np.concatenate([effects, np.abs(effects), effects * effects, unbiased], axis=1)

    def measured(self, means: Floats, parameters: int) -> dict[str, Floats]:
        """Return mean magnitude, mean and spread."""
        mean, magnitude, square = (
            means[..., part * parameters : (part + 1) * parameters] for part in range(3)
        )
        variance = np.maximum(square - mean * mean, 0.0) * means[..., -1:]
        return {"mean_magnitude": magnitude, "mean_effect": mean, "spread": np.sqrt(variance)}
