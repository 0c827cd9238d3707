"""States at the start of a run, from the pose and the velocity of the assembled mechanism."""

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.absolute_holding import world_axis
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import inner_states


def start_state(scene: Scene, coordinates: Sequence[str], pose: Floats, velocity: Floats) -> Floats:
    """Return the states of the start, (states,), from absolute poses (3 bodies,) and their rates.

    (states, points) from rates (3 bodies, points).
    Coordinates, then their speeds, then inner states of friction laws in the order of pairs.
    """
    bodies = list(scene.bodies)
    position, speed = [], []
    for name in coordinates:
        body, kind = name.split(".")
        i = 3 * bodies.index(body)
        if kind == "s":
            at, rate = travel(scene, body, pose, velocity)
        else:
            at, rate = (a[i + ("x", "y", "theta").index(kind)] for a in (pose, velocity))
        position.append(at)
        speed.append(rate)
    inner = [state.start for states in inner_states(scene).values() for state in states]
    return np.array(np.broadcast_arrays(*position, *speed, *inner), np.float64)


def travel(scene: Scene, body: str, pose: Floats, velocity: Floats) -> tuple[Scalar, Scalar]:
    """Return the displacement along a prismatic joint that carries a body, m, and its rate."""
    numbers = view(scene)
    mechanism = AbsoluteMechanism(scene, numbers, close_play=False)
    joint = numbers.joints[spanning_tree(scene).branch(body).joint]
    assert joint.heading is not None  # noqa: S101  (narrows the type)
    ux, uy = world_axis(joint.heading, mechanism.marker(joint.points[0], pose, velocity))
    between = mechanism.ends(joint.points, pose, velocity)
    gap, rate, (spin, _) = between.gap, between.rate, between.spins
    turned = spin * (-uy * gap[0] + ux * gap[1])
    return ux * gap[0] + uy * gap[1], ux * rate[0] + uy * rate[1] + turned


def mechanism_size(scene: Scene, least: float) -> float:
    """Return the longest distance between two points of one body, m: a lever for angles."""
    distances = [
        math.dist(a, b)
        for body in scene.bodies.values()
        for a, b in combinations(body.points.values(), 2)
    ]
    return max([*distances, least])
