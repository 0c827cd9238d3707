"""An independent program: SciPy's DOP853 on the float mechanics, in absolute coordinates.

It shares with the solver the readable mechanics (which other tests hold to the laws of nature)
and nothing of what makes a run: no tracer, no kernel, no step control, no dense output of ours,
no search for onsets. Onsets are located by SciPy's events; every contact is a restart.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.impact_floors import impact_floor
from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from tests.solver.readable_mechanics import Instant, at_start

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Onset:
    """A contact that began: joint, time (s), penetration rate (m/s)."""

    joint: str
    time: float
    rate: float


class IndependentProgram:
    """One scene, integrated from its start in joint coordinates."""

    def __init__(self, scene: Scene, tolerance: float, longest_step: float) -> None:
        self.scene = scene
        self.tolerance, self.longest_step = tolerance, longest_step
        self.names = spanning_tree(scene).coordinates
        self.start = at_start(scene)
        self.onsets: list[Onset] = []

    def run(self, end: float) -> Motion:
        """Return the motion at a time, s."""
        start = self.start
        state = np.array([*start.position.values(), *start.speed.values()])
        mode, impact_rate = dict(start.mode), dict(start.impact_rate)
        now = 0.0
        while now < end:
            joints = list(mode)
            solution = solve_ivp(
                lambda t, y, m=dict(mode), r=dict(impact_rate): self._slope(t, y, m, r),
                (now, end),
                state,
                method="DOP853",
                rtol=self.tolerance,
                atol=self.tolerance * 1e-3,
                max_step=self.longest_step,
                events=[self._crossing(joint, mode, impact_rate) for joint in joints],
            )
            now, state = float(solution.t[-1]), solution.y[:, -1]
            for joint, times in zip(joints, solution.t_events or [], strict=True):
                if not len(times):
                    continue
                if mode[joint] > 0.0:
                    mode[joint] = 0.0
                    continue
                contact = self._instant(now, state, mode, impact_rate).reduced().contacts[joint]
                pair = contact_pairs(self.scene)[joint]
                floor = impact_floor(self.scene, pair, shortest_link(self.scene))
                mode[joint] = 1.0
                impact_rate[joint] = max(contact.penetration_rate, floor)
                self.onsets.append(Onset(joint, now, contact.penetration_rate))
        return self._instant(end, state, mode, impact_rate).reduced()

    def _instant(
        self, t: float, y: Floats, mode: dict[str, float], impact_rate: dict[str, float]
    ) -> Instant:
        count = len(self.names)
        values = [float(x) for x in y]
        drivers = self.scene.drivers.items()
        return replace(
            self.start,
            position=dict(zip(self.names, values[:count], strict=True)),
            speed=dict(zip(self.names, values[count:], strict=True)),
            driven={name: driver.clock_start + driver.clock_rate * t for name, driver in drivers},
            mode=mode,
            impact_rate=impact_rate,
        )

    def _slope(
        self, t: float, y: Floats, mode: dict[str, float], impact_rate: dict[str, float]
    ) -> list[float]:
        motion = self._instant(t, y, mode, impact_rate).reduced()
        return [*(float(v) for v in y[len(self.names) :]), *motion.accelerations]

    def _crossing(self, joint: str, mode: dict[str, float], impact_rate: dict[str, float]):
        """Return SciPy's event: the gap closes, or opens where it is in contact."""
        closed = mode[joint] > 0.0
        modes, rates = dict(mode), dict(impact_rate)

        def gap(t: float, y: Floats) -> float:
            return self._instant(t, y, modes, rates).reduced().contacts[joint].penetration

        gap.terminal = True  # type: ignore[attr-defined]  # SciPy reads attributes of functions
        gap.direction = -1.0 if closed else 1.0  # type: ignore[attr-defined]
        return gap
