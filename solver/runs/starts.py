"""Perturbed starts of an ensemble: the same member starts the same wherever it is computed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.loop.start import mechanism_size
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import clearances

Floats = NDArray[np.float64]


class Perturbation(NamedTuple):
    """Of an ensemble's starts: standard deviation in the scales of `start_scales`, and seed."""

    spread: float
    seed: int


def perturbed_start(
    position: Floats,
    speed: Floats,
    scales: tuple[Floats, Floats],
    perturbation: Perturbation,
    member: int,
) -> tuple[Floats, Floats]:
    """Return the start of a member: independent normal deviates about the scene's own start.

    Member 0 is unperturbed. A member depends on the seed and its own number alone, through the
    counter-based generator Philox (Salmon et al. 2011) keyed by both.

    Parameters
    ----------
    position, speed : (coordinates,) float
        The scene's start: m or rad, m/s or rad/s.
    scales : pair of (coordinates,) float
        What a deviate of one stands for in each position and speed; see `start_scales`.
    perturbation : Perturbation
        Its seed, below 2^64, is one half of the generator's key.
    member : int
        The other half.

    Returns
    -------
    (coordinates,) float, (coordinates,) float
        Positions and speeds.
    """
    if member == 0:
        return position.copy(), speed.copy()
    generator = np.random.Generator(
        np.random.Philox(key=np.array([perturbation.seed, member], np.uint64))
    )
    deviates = perturbation.spread * generator.standard_normal((2, len(position)))
    return position + deviates[0] * scales[0], speed + deviates[1] * scales[1]


def start_scales(scene: Scene, coordinates: Sequence[str], period: float) -> tuple[Floats, Floats]:
    """Return what perturbations of a start are measured in: (coordinates,) positions and speeds.

    Positions in the finest clearance, m; angles in the turn, rad, that moves the end of the longest
    body that far; speeds in the same per period/2 pi (s). Without clearance: the shortest link.
    """
    length = shortest_link(scene)
    play = [clearance.radial_clearance for clearance in clearances(scene).values()]
    finest = min(play, default=length)
    turn = finest / mechanism_size(scene, length)
    position = np.array([turn if name.endswith(".theta") else finest for name in coordinates])
    return position, position * (2.0 * math.pi / period)
