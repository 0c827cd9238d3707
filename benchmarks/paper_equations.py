"""The paper's equations as a user would write them: 18 coordinates, multipliers, Baumgarte, SciPy.

The impact rate is latched inside the right-hand side, as is usual, though it does not converge so.
"""

import time

import numpy as np
from scipy.integrate import solve_ivp

from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.lagrange import LagrangeMechanism
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import common_period

SIMULATED = 0.02
"""Simulated time that SciPy gets, s; the rest is scaled."""


def seconds_a_period(scene: Scene) -> float:
    """Return what RK45 at 1e-6 takes for one period of a press, scaled from `SIMULATED`."""
    period = common_period(scene).seconds
    assert period is not None
    numbers, assembly = view(scene), assemble(scene)
    half = 3 * len(scene.bodies)
    mode = dict.fromkeys(("A", "B"), 0.0)
    rate = dict.fromkeys(mode, 1e-3)

    def slope(t: float, y: np.ndarray) -> list[float]:
        driven = {name: d.clock_start + d.clock_rate * t for name, d in scene.drivers.items()}
        state = [float(x) for x in y]
        mechanism = LagrangeMechanism(scene, numbers, state[:half], state[half:], driven)
        motion = mechanism.motion(mode, rate)
        for name, found in motion.contacts.items():
            closed = found.penetration > 0.0
            if closed and mode[name] == 0.0:
                rate[name] = max(found.penetration_rate, 1e-3)
            mode[name] = float(closed)
        return [*state[half:], *motion.accelerations]

    begun = time.process_time()
    start = np.concatenate([assembly.pose, assembly.velocity])
    solve_ivp(slope, (0.0, SIMULATED), start, method="RK45", rtol=1e-6, atol=1e-9)
    return (time.process_time() - begun) * period / SIMULATED
