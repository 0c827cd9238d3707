"""Runs of a peer from each onset or release to the next, over our compiled right-hand side."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import DOP853, LSODA, RK45, OdeSolver, solve_ivp

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem

SCIPY: dict[str, type[OdeSolver]] = {"RK45": RK45, "DOP853": DOP853, "LSODA": LSODA}
FIRST_STEP, LONGEST_STEP = 1e-7, 1e-3
"""First step of peers, s: a force that is zero at an onset misleads their own choice."""


class CompiledEquations:
    """The kernel's right-hand side for one lane, as a peer calls it."""

    def __init__(self, kernel: Kernel, problem: LaneProblem) -> None:
        self.bundle = Bundle(kernel, [problem])
        self.states, self.joints = kernel.states, len(kernel.pairs)
        self.start = self.bundle.state_of(0).state
        self.lane = self.bundle.lane(0)
        self._evaluate = kernel.module.right_hand_side
        self.evaluations = 0
        self.floor = self.lane["impact_floor"].copy()

    def slope(self, t: float, y: np.ndarray, mode: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """Return the slopes of coordinates and speeds."""
        self.evaluations += 1
        lane = self.lane
        lane["stage"], lane["stage_time"] = y, t
        lane["mode"], lane["impact_rate"] = mode, rate
        self._evaluate(lane.work)
        return lane["slope"].copy()

    def penetrations(
        self, t: float, y: np.ndarray, mode: np.ndarray, rate: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the penetration of each joint and its rate."""
        self.slope(t, y, mode, rate)
        return self.lane["penetration"].copy(), self.lane["penetration_rate"].copy()


Leg = Callable[[float, np.ndarray, float, np.ndarray, np.ndarray], tuple[float, np.ndarray, int]]
"""(time, state, end, modes, impact rates) -> time and state where a gap passes zero, and the joint,
or the end."""


def by_legs(equations: CompiledEquations, leg: Leg, end: float) -> np.ndarray:
    """Return the state at the end: a leg from each onset or release to the next."""
    now, state = 0.0, equations.start.copy()
    mode = np.zeros(equations.joints)
    rate = equations.floor.copy()
    while True:
        now, state, joint = leg(now, state, end, mode, rate)
        if now >= end:
            return state
        mode[joint] = 1.0 - mode[joint]
        if mode[joint]:
            penetration_rate = equations.penetrations(now, state, mode, rate)[1]
            rate[joint] = max(penetration_rate[joint], equations.floor[joint])


def scipy_leg(equations: CompiledEquations, method: str, tolerance: float) -> Leg:
    """Return legs by one of SciPy's methods."""

    def event(joint: int, mode: np.ndarray, rate: np.ndarray) -> Callable[..., float]:
        def penetration(t: float, y: np.ndarray) -> float:
            return float(equations.penetrations(t, y, mode, rate)[0][joint])

        penetration.terminal = True  # type: ignore[attr-defined]
        penetration.direction = -1.0 if mode[joint] else 1.0  # type: ignore[attr-defined]
        return penetration

    def leg(
        now: float, state: np.ndarray, end: float, mode: np.ndarray, rate: np.ndarray
    ) -> tuple[float, np.ndarray, int]:
        found = solve_ivp(
            lambda t, y: equations.slope(t, y, mode, rate),
            (now, end),
            state,
            method=SCIPY[method],
            rtol=tolerance,
            atol=1e-3 * tolerance,
            first_step=min(FIRST_STEP, end - now),
            max_step=LONGEST_STEP,
            events=[event(joint, mode, rate) for joint in range(equations.joints)],
        )
        assert found.t_events is not None
        fired = [len(times) for times in found.t_events]
        return float(found.t[-1]), found.y[:, -1], int(np.argmax(fired))

    return leg


def cvode_leg(equations: CompiledEquations, method: str, tolerance: float) -> Leg | None:
    """Return legs by CVODE; none where scikit-sundae is not installed."""
    try:
        from sksundae.cvode import CVODE
    except ImportError:
        return None

    def leg(
        now: float, state: np.ndarray, end: float, mode: np.ndarray, rate: np.ndarray
    ) -> tuple[float, np.ndarray, int]:
        def slope(t: float, y: np.ndarray, out: np.ndarray) -> None:
            out[:] = equations.slope(t, y, mode, rate)

        def passes(t: float, y: np.ndarray, out: np.ndarray) -> None:
            out[:] = equations.penetrations(t, y, mode, rate)[0]

        passes.terminal = [True] * equations.joints  # type: ignore[attr-defined]
        passes.direction = [-1 if closed else 1 for closed in mode]  # type: ignore[attr-defined]
        integrator = CVODE(
            slope,
            method=method,
            rtol=tolerance,
            atol=1e-3 * tolerance,
            first_step=FIRST_STEP,
            max_step=LONGEST_STEP,
            max_num_steps=10**6,
            eventsfn=passes,
            num_events=equations.joints,
        )
        found = integrator.solve(np.array([now, end]), state)
        fired = np.abs(np.atleast_1d(found.i_events)[-1]) if found.i_events is not None else [0]
        return float(found.t[-1]), np.array(found.y[-1]), int(np.argmax(fired))

    return leg
