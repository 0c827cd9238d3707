"""Points that have come to rest: equilibria of scenes that nothing drives."""

import math
from collections.abc import Iterator

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.nonlinear.verdict import RESTING
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.clocks import timed
from jointplay.solver.scene.document import Scene

RATES = (("vx", 0, 1), ("vy", 0, 1), ("omega", 1, 1), ("ax", 0, 2), ("ay", 0, 2), ("alpha", 1, 2))
"""Channels of a body that vanish at rest: of an angle or not, and how often over time."""


def state_at_rest(bundle: Bundle, lane: int, scene: Scene, period: float) -> Iterator[Floats]:
    """Yield the state of a lane, (states,), where nothing moves and nothing is about to.

    scene : that the lane runs; one that is driven, or pushed by a force over time, is never at
    rest. period : s, the unit of time.
    """
    if scene.drivers or timed(scene):
        return
    length, angle = _units(scene)
    seconds = period / (2.0 * math.pi)
    names, limits = [], []
    for body in scene.bodies:
        for channel, turning, order in RATES:
            names.append(f"{body}.{channel}")
            limits.append(RESTING * (angle if turning else length) / seconds**order)
    columns = np.array([bundle.kernel.rows.index(name) for name in names], np.int64)
    rates = bundle.observe(lane, bundle.lane(lane).row(), columns)[0]
    if (np.abs(rates) <= np.array(limits)).all():
        yield np.asarray(bundle.state_of(lane).state)


def _units(scene: Scene) -> tuple[float, float]:
    """Return what counts as one length, m, and as one angle, rad."""
    length, angle, *_ = start_scales(scene, ("x", ".theta"), 1.0, scene.length)
    return float(length), float(angle)
