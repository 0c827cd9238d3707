"""Drivers that prescribe what joints or other drivers prescribe already."""

import numpy as np

from jointplay.solver.mechanics.closing import rank
from jointplay.solver.mechanics.constraints_at_start import constraints_at_start
from jointplay.solver.scene.document import Scene


def conflicting_drivers(scene: Scene) -> list[str]:
    """Return the drivers whose motion the joints and the other drivers prescribe already.

    None where the joints alone are redundant: then they may be to blame.
    """
    ideal, rows, jacobian, _ = constraints_at_start(scene)
    driving = {(name, "angle"): name for name in ideal.turned.values()}
    for joint, name in ideal.drivers.items():
        driving[joint, scene.joints[joint].driven_part or ""] = name
    drivers = [driving.get((row.joint, row.part), "") for row in rows]
    joints = jacobian[[not driver for driver in drivers]]
    if rank(joints) < len(joints):
        return []
    every = rank(jacobian)
    return [
        driver
        for k, driver in enumerate(drivers)
        if driver and rank(np.delete(jacobian, k, axis=0)) == every
    ]
