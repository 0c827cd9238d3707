"""After how many periods of the drive wheels behind gears are back, as half as fast ones after two.

A section with crank angle 0 is one of the same mechanism only then: in between teeth have others
beside them.
"""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.laws.function.whole_turn import TURN
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene

MOST_PERIODS = 1000
"""Periods up to which whole turns of a wheel are told from others."""
EXACT = 1e-9
"""Turns within which they are whole: what steps of runs leave of a wheel that is driven."""


def geared_angles(scene: Scene, coordinates: Sequence[str]) -> list[int]:
    """Return the indices of the angles that gears couple among a scene's coordinates."""
    bodies = {body for gear in scene.gears.values() for _, body in gear.coupled(scene.joints)}
    return [k for k, name in enumerate(coordinates) if name in {f"{body}.theta" for body in bodies}]


def periods_until_back(turns: Floats) -> int:
    """Return the least number of periods after which all angles have made whole turns.

    turns : (angles,) in one period. 1 where that is not known: turns are no fractions of small
    numbers, as of motion that does not repeat.
    """
    fractions = [Fraction(one).limit_denominator(MOST_PERIODS) for one in turns.tolist()]
    if np.abs(turns - np.array(fractions, np.float64)).max(initial=0.0) > EXACT:
        return 1
    return math.lcm(*(one.denominator for one in fractions))


def driven_wheels_back_after(scene: Scene, period: float) -> int:
    """Return the least number of periods, of so many s, after which driven wheels are back.

    Of wheels that nothing drives where they are says how far they have turned: they do not count.
    """
    if not scene.gears:
        return 1
    begun, gone = (_geared(scene, time) for time in (0.0, period))
    return periods_until_back((gone - begun) / TURN)


def _geared(scene: Scene, time: float) -> Floats:
    """Return by how much each gear is off at a time if only drivers turn, (gears,), rad."""
    tree = spanning_tree(scene)
    rest = dict.fromkeys(tree.coordinates, 0.0)
    driven = {name: one.start + one.rate * time for name, one in clocks(scene).items()}
    moved = Kinematics(tree, view(scene), rest, rest, driven)
    found = [
        sum(factor * moved.whole_angle(body) for factor, body in gear.coupled(scene.joints))
        for gear in scene.gears.values()
    ]
    return np.array(found, np.float64)
