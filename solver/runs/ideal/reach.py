"""Which values the motion of a driven mechanism can reach, with its play and before it is run."""

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.observe import body_values
from jointplay.solver.runs.ideal.motion import IdealMotion
from jointplay.solver.scene.channels import BODY
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import ContactPair, contact_pairs
from jointplay.solver.scene.periods import drivers_period
from jointplay.solver.scene.time_scales import quickest_driver

QUANTITIES = tuple(quantity for quantity, _, _ in BODY)
INSTANTS_A_PERIOD = 96
MOST_SCALES = 100.0
"""Turns of the fastest driver in a period, above which it is not followed."""
SLACK = 0.01
"""Share of a range that is granted beyond it: extremes lie between the instants looked at."""
SECOND_ORDER = 2.0
"""Times the first-order displacement by play: what it leaves out, and the penetration."""
NOTHING = 1e-12
"""Share of the largest displacement by play that is the rounding of none."""


@dataclass(frozen=True)
class Reach:
    """Range of a body's channel in a period, in its unit."""

    low: float
    high: float
    turns: int = 0
    """Whole turns that an angle gains in a period."""


class MotionReach:
    """The reach of all bodies of a scene whose drivers leave no freedom but the play."""

    def __init__(self, scene: Scene, period: float) -> None:
        self.motion = IdealMotion(scene, period, math.inf)
        self.bodies = list(scene.bodies)
        pairs = contact_pairs(scene).values()
        play = {pair.joint: _travel(pair) for pair in pairs}
        lifts = {pair.joint: pair.loosened for pair in pairs if pair.of.one_sided}
        end = self.motion.path.end.time
        scales = math.ceil(end / self.motion.path.scale)
        self.instants = np.linspace(0.0, end, INSTANTS_A_PERIOD * scales + 1)
        self.poses, self.strayed, self.lifted = np.empty(0), np.empty(0), np.empty(0)
        if self.motion.lost is None:
            self.poses = self.motion.path.poses(self.instants)
            self.strayed = SECOND_ORDER * self.motion.displacements(play, self.instants)
            self.lifted = self.motion.displacements(lifts, self.instants).max(axis=0)

    def of(self, body: str, quantity: str) -> Reach | None:
        """Return the reach of a body's channel; None where play leaves it open.

        With play a velocity or an acceleration can be anything, unless the play does not reach
        the body at all: then it moves as the ideal one does. So can the position of what a follower
        carries along when it lifts off.
        """
        order, axis = divmod(QUANTITIES.index(quantity), 3)
        column = 3 * self.bodies.index(body) + axis
        if self.lifted[column] > NOTHING * self.strayed.max():
            return None
        if order == 0:
            path, strayed = self.poses[:, column], self.strayed[:, column]
            turns = 0
            if quantity == "theta":
                turns = round((path[-1] - path[0]) / (2.0 * math.pi))
            return _widened(path - strayed, path + strayed, turns)
        if self.strayed[:, column].max() > NOTHING * self.strayed.max():
            return None
        values = body_values(self.motion.at(self.instants, self.instants).bodies[body])
        moved = values[QUANTITIES.index(quantity)]
        return _widened(moved, moved, 0)


def motion_reach(scene: Scene) -> MotionReach | None:
    """Return the reach of a scene's bodies; None where the ideal mechanism cannot be followed.

    So it is with a mechanism that moves freely, has gears, a long period or none, or a dead point.
    """
    period = drivers_period(scene).seconds
    if period is None or scene.gears:
        return None
    if period > MOST_SCALES * quickest_driver(scene, shortest_link(scene)):
        return None
    try:
        found = MotionReach(scene, period)
    except np.linalg.LinAlgError:
        return None
    return None if found.motion.lost is not None else found


def _travel(pair: ContactPair) -> dict[str, float]:
    """Return by how much a pair may violate its joint's constraints, m or rad by part.

    However soft a contact is: the centre of a journal is within its bearing.
    """
    most = max(1.0, pair.size / (SECOND_ORDER * pair.play)) if pair.is_journal else 1.0
    return {part: most * loosened for part, loosened in pair.loosened.items()}


def _widened(low: Floats, high: Floats, turns: int) -> Reach:
    bottom, top = float(low.min()), float(high.max())
    rounding = 1e-9 * max(abs(bottom), abs(top))
    if top - bottom <= rounding:
        return Reach(bottom, bottom, turns)
    slack = SLACK * (top - bottom)
    return Reach(bottom - slack, top + slack, turns)
