"""Channels that say how long a trajectory is known, and sizes that errors are compared with."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.runs.certificate.estimate import CONVERGED
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

ECCENTRICITY = ("eccentricity_x", "eccentricity_y")
GAP = "penetration"
COORDINATES = ("x", "y", "theta")
HARDLY = 1e-3
"""A channel that moves by less than this share of another of its unit is measured by that one."""
CRITERION = (
    "the estimated error of each journal's centre, and of the gap at each corner of a slider, wall"
    f" of a slot and cam, is below {CONVERGED:g} of the clearance from side to side, and that of"
    f" each body's position and angle below {CONVERGED:g} of its range"
)
UNCONTROLLED_CRITERION = f"{CRITERION} until then, in the companion that moved least"


def motion_of(scene: Scene) -> dict[str, str]:
    """Return channels whose errors say how long the trajectory is known, with their units.

    Where each joint with play is in it, and where each body is: the range of a body is often
    many clearances, so that its position says nothing about what touches.
    """
    found: dict[str, str] = {}
    for name, pair in contact_pairs(scene).items():
        parts = ECCENTRICITY if pair.is_journal else (GAP,)
        found |= {f"{name}.{part}": "m" for part in parts}
    for body in scene.bodies:
        found |= {f"{body}.{part}": "rad" if part == "theta" else "m" for part in COORDINATES}
    return found


def scales_of(
    values: Floats, names: Sequence[str], units: Sequence[str], scene: Scene, controlled: bool
) -> Floats:
    """Return what errors are compared with, (instants, channels), in the channels' units.

    Of positions in a joint's play, the clearance from side to side; of all else the range of
    `values`, (lanes, instants, channels), where NaN is a lane that did not come so far.

    controlled : whether errors of steps are. Where they are not, lanes may blow up, and the range
    of what blew up says nothing about the motion: the range at an instant is then that until
    there, of the lane with the smallest.
    """
    reached = values[~np.isnan(values).any(axis=(1, 2))]
    if not len(reached):
        reached = np.nan_to_num(values)
    if controlled:
        ranges = np.broadcast_to(np.ptp(reached, axis=(0, 1)), values.shape[1:])
    else:
        so_far = np.maximum.accumulate(reached, axis=1) - np.minimum.accumulate(reached, axis=1)
        ranges = so_far.min(axis=0)
    of_unit = np.array(units)
    largest = np.array([ranges[:, of_unit == unit].max(axis=1) for unit in units]).T
    scales: Floats = np.maximum(ranges, HARDLY * largest)
    finest = start_scales(scene, names, 1.0)  # of positions and angles, where there is play
    play = contact_pairs(scene)
    for column, name in enumerate(names):
        part, _, quantity = name.rpartition(".")
        if part in play and quantity in (*ECCENTRICITY, GAP):
            scales[:, column] = 2.0 * play[part].play
        elif play and part and quantity in COORDINATES:  # an output may be called so, too
            scales[:, column] = np.maximum(scales[:, column], finest[column])
    return scales
