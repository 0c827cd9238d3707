"""Perturbed starts of an ensemble: the same member starts the same wherever it is computed."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.start.states import mechanism_size
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.references import inner_states


class Perturbation(NamedTuple):
    """Spread of an ensemble's starts, a standard deviation in `start_scales`, and its seed."""

    spread: float
    seed: int


def perturbed_start(
    state: Floats, scales: Floats, perturbation: Perturbation, member: int
) -> Floats:
    """Return the start of a member, (states,): independent normal deviates about the scene's own.

    Member 0 is unperturbed. A member depends on the seed and its own number alone, through the
    counter-based generator Philox (Salmon et al. 2011) keyed by both, each below 2^64.

    state : (states,) m or rad, m/s or rad/s, then inner states. scales : (states,) what a deviate
    of one stands for; see `start_scales`.
    """
    if member == 0:
        return state.copy()
    generator = np.random.Generator(
        np.random.Philox(key=np.array([perturbation.seed, member], np.uint64))
    )
    return state + perturbation.spread * generator.standard_normal(len(state)) * scales


def start_scales(
    scene: Scene, coordinates: Sequence[str], period: float, given: float | None = None
) -> Floats:
    """Return what perturbations of a start are measured in, (states,).

    Positions in the finest clearance, m; angles in the turn, rad, that moves the end of the longest
    body that far; speeds in the same per period/2 pi (s); inner states in scales of their own.
    Without clearance: the shortest link. given : m, before both, such as the scene's `length`.
    """
    length = shortest_link(scene)
    play = [pair.play for pair in contact_pairs(scene).values()]
    finest = min(play, default=length) if given is None else given
    turn = finest / mechanism_size(scene, length)
    position = np.array([turn if name.endswith(".theta") else finest for name in coordinates])
    inner = [state.scale for states in inner_states(scene).values() for state in states]
    return np.concatenate([position, position * (2.0 * math.pi / period), inner])
