"""Functions whose sensitivities are known in closed form, at the points of our designs."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure, PointStatus
from jointplay.records.study import StudyDataset
from jointplay.solver.designs import DESIGNS

Floats = NDArray[np.float64]
A, B = 7.0, 0.1
COEFFICIENTS = np.array([0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0])

ISHIGAMI_VARIANCE = 13.844587940719254
ISHIGAMI = {
    "first_order": (0.3139051911, 0.4424111448, 0.0),
    "total": (0.5575888552, 0.4424111448, 0.2436836640),
}
G_FUNCTION = {
    "first_order": (0.7161921688, 0.1790480422, 0.0236757742, 0.0071619217, *4 * (0.0000716192,)),
    "total": (0.7871441266, 0.2421981928, 0.0343169102, 0.0104603871, *4 * (0.0001049491,)),
}
FOUR_BRANCHES = {6.0: 4.457331490626e-3, 7.0: 2.222795066194e-3}
"""By p, the probability that the least of four branches is below zero."""


def ishigami(shares: Floats) -> Floats:
    """Return Ishigami's function of three shares of the range -pi to pi."""
    x, y, z = np.moveaxis(np.pi * (2.0 * shares - 1.0), -1, 0)
    return np.asarray(np.sin(x) + A * np.sin(y) ** 2 + B * z**4 * np.sin(x))


def g_function(shares: Floats) -> Floats:
    """Return Sobol's g-function of eight shares."""
    factors = (np.abs(4.0 * shares - 2.0) + COEFFICIENTS) / (1.0 + COEFFICIENTS)
    return np.asarray(factors.prod(axis=-1))


def four_branches(x: Floats, p: float) -> Floats:
    """Return the least branch at two normal deviates; where it is below zero there is failure."""
    apart, together = (x[..., 0] - x[..., 1]), (x[..., 0] + x[..., 1]) / np.sqrt(2.0)
    arms = 3.0 + 0.1 * apart**2 - np.abs(together)
    return np.asarray(np.minimum(arms, p / np.sqrt(2.0) - np.abs(apart)))


def study_of(
    function: Callable[[Floats], Floats],
    rows: int,
    parameters: int,
    design: str = "saltelli",
    *,
    seed: int = 0,
    failed: tuple[int, ...] = (),
    waiting: tuple[int, ...] = (),
    tolerance: float = 1e-9,
) -> StudyDataset:
    """Return a study whose channel ``rod.x`` has the function of shares as its largest value."""
    shares = DESIGNS[design](rows, parameters, seed).reshape(-1, parameters)
    status = np.full(len(shares), PointStatus.done, np.uint8)
    status[list(failed)] = PointStatus.failed
    status[list(waiting)] = PointStatus.waiting
    known = np.where(status == PointStatus.done, function(shares), np.nan)
    job: dict[str, Any] = {"kind": "sensitivity", "design": design, "tolerance": tolerance}
    return StudyDataset(
        attributes={
            "job": job,
            "scene": {},
            "meanings": {"rod.x.mean": ("m", "mean of position of the rod")},
        },
        parameters=[Channel(f"p{number}", "m", "") for number in range(parameters)],
        values=shares,
        status=status,
        channels=[Channel("rod.x", "m", "position of the rod")],
        extremes={"rod.x": PeakColumns(-known, known, known, known)},
        statistics={"rod.x.mean": np.where(np.isnan(known), np.nan, 3.0)},
        failures={point: Failure("x", "It failed.", 0.1) for point in failed},
    )
