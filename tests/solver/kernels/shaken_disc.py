"""An impact oscillator, twice: as a scene, and as a program of its own on SciPy.

A disc lies in a bearing whose centre runs round a small circle; gravity holds it back, contact
throws it. Without friction only the disc's centre matters: a point in a round pit. At the speed
chosen it is thrown two or three times a turn, and its motion is chaotic.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from jointplay.solver.scene.document import Scene
from tests.solver.readable_mechanics import scene_of

Floats = NDArray[np.float64]

RADIUS, SPEED, CLEARANCE = 2e-3, 60.0, 2e-3
STIFFNESS, RESTITUTION, GRAVITY, FLOOR = 1e8, 0.8, 9.81, 1e-3
PERIOD = 2.0 * math.pi / SPEED


def shaken_disc() -> Scene:
    """Return the scene; the disc of 1 kg starts in the middle of its bearing."""
    contact = {
        "stiffness": STIFFNESS,
        "restitution": RESTITUTION,
        "impact_rate_floor": FLOOR,
    }
    return scene_of(
        {
            "name": "shaken-disc",
            "gravity": [0.0, -GRAVITY],
            "ground": {"points": {"O": [0.0, 0.0]}},
            "bodies": {
                "shaker": {
                    "mass": 1.0,
                    "inertia": 1e-3,
                    "points": {"pivot": [0.0, 0.0], "seat": [RADIUS, 0.0]},
                },
                "disc": {"mass": 1.0, "inertia": 1e-4, "points": {"centre": [0.0, 0.0]}},
            },
            "joints": {
                "O": {"type": "revolute", "bearing": "ground.O", "journal": "shaker.pivot"},
                "P": {
                    "type": "revolute",
                    "bearing": "shaker.seat",
                    "journal": "disc.centre",
                    "clearance": {
                        "radial_clearance": CLEARANCE,
                        "bearing_radius": 0.01,
                        "contact": contact,
                    },
                },
            },
            "drivers": {"motor": {"joint": "O", "position": 0.0, "speed": SPEED}},
        }
    )


@dataclass
class Point:
    """The disc's centre: x, y, and their rates; whether it touches, and since what rate."""

    state: Floats
    time: float = 0.0
    touching: bool = False
    impact_rate: float = FLOOR

    def run(self, end: float) -> None:
        """Go on to a time, s, from one onset or release to the next."""
        while self.time < end:
            solution = solve_ivp(
                self._slope,
                (self.time, end),
                self.state,
                method="DOP853",
                rtol=1e-12,
                atol=1e-15,
                max_step=PERIOD / 100.0,
                events=self._event(),
            )
            self.time, self.state = float(solution.t[-1]), solution.y[:, -1]
            if len((solution.t_events or [[]])[0]):
                self.touching = not self.touching
                if self.touching:
                    self.impact_rate = max(self._gap(self.time, self.state)[1], FLOOR)

    def _event(self):
        def penetration(t: float, state: Floats) -> float:
            return self._gap(t, state)[0]

        penetration.terminal = True  # type: ignore[attr-defined]  # SciPy reads attributes of functions
        penetration.direction = -1.0 if self.touching else 1.0  # type: ignore[attr-defined]
        return penetration

    @staticmethod
    def _gap(t: float, state: Floats) -> tuple[float, float, float, float]:
        """Return penetration, its rate, and the normal."""
        cosine, sine = math.cos(SPEED * t), math.sin(SPEED * t)
        ex, ey = state[0] - RADIUS * cosine, state[1] - RADIUS * sine
        vx, vy = state[2] + RADIUS * SPEED * sine, state[3] - RADIUS * SPEED * cosine
        distance = math.hypot(ex, ey) or 1.0  # in the middle, where it starts: no normal
        nx, ny = ex / distance, ey / distance
        return distance - CLEARANCE, vx * nx + vy * ny, nx, ny

    def _slope(self, t: float, state: Floats) -> list[float]:
        fx, fy = 0.0, -GRAVITY
        if self.touching:
            depth, rate, nx, ny = self._gap(t, state)
            depth = max(depth, 0.0)
            damping = 0.75 * (1.0 - RESTITUTION**2) / self.impact_rate
            force = max(STIFFNESS * depth**1.5 * (1.0 + damping * rate), 0.0)
            fx, fy = -force * nx, fy - force * ny
        return [state[2], state[3], fx, fy]
