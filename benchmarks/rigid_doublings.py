"""Whether a rigid stop's doublings are soft: the cubic coefficient of the map between impacts.

That map takes time and speed of an impact to those of the next; it is solved by Newton's method,
and differentiated next to the closed form of the orbit that doubles. Coefficients of other sections
have the same sign.
"""

import math

import numpy as np
from scipy.optimize import brentq

from benchmarks.rigid_stop import GAP, RESTITUTION, doubling, flow, one_impact
from jointplay.records.arrays import Floats

DISTANCES = (8e-3, 4e-3)
"""From the orbit, in radians of the drive and in speeds of the impact."""
EXACT = 1e-15
SPEEDS = (18.95, 19.1)  # rad/s


class Impacts:
    """Impacts next to the orbit that doubles its period at a speed, rad/s."""

    def __init__(self, speed: float) -> None:
        """Find the orbit."""
        steady, impact = one_impact(np.array([speed]), -1.0)
        self.speed, self.impact = speed, float(impact[0])
        self.position, self.rate = steady[:, 0].tolist()

    def steady(self, angle: float) -> Floats:
        """Return displacement and rate of the steady motion, by the drive's angle, rad."""
        sine, cosine = math.sin(angle), math.cos(angle)
        across = self.rate / self.speed
        position = self.position * cosine + across * sine
        return np.array([position, self.speed * (across * cosine - self.position * sine)])

    def after(self, away: Floats) -> Floats:
        """Return how far the next impact is away: angle, rad, and the share of its speed."""
        angle, impact = float(away[0]), self.impact * (1.0 + float(away[1]))
        free = np.array([GAP, -RESTITUTION * impact]) - self.steady(angle)
        turned = 2.0 * math.pi
        while True:
            behind = flow(np.array(turned / self.speed)) @ free + self.steady(angle + turned)
            step = self.speed * (behind[0] - GAP) / behind[1]
            turned -= step
            if abs(step) < EXACT * turned:
                return np.array([angle + turned - 2.0 * math.pi, behind[1] / self.impact - 1.0])

    def jacobian(self) -> Floats:
        """Return the derivative of `after` at the orbit."""
        steps = 1e-5 * np.eye(2)
        return np.array([(self.after(one) - self.after(-one)) / 2e-5 for one in steps]).T


def cubic_coefficient(speed: float) -> float:
    """Return the coefficient of the doubling; see `solver.continuation.criticality`."""
    near = Impacts(speed)
    jacobian = near.jacobian()
    matrix = jacobian + np.eye(2)
    right, left = np.array([-matrix[0, 1], matrix[0, 0]]), np.array([-matrix[1, 0], matrix[0, 0]])
    right /= np.hypot(*right)
    left /= np.sum(left * right)

    def grown(at: float, bent: Floats) -> float:
        ends = [near.after(sign * at * right + 0.5 * at * at * bent) for sign in (1.0, -1.0)]
        return float(np.sum(left * (ends[0] - ends[1]))) / (2.0 * at)

    found = []
    for one in DISTANCES:
        even = (near.after(one * right) + near.after(-one * right)) / (one * one)
        bent = np.asarray(np.linalg.solve(np.eye(2) - jacobian, even), np.float64)
        found.append((grown(one, bent) - grown(0.5 * one, bent)) / (0.75 * one * one))
    return (4.0 * found[1] - found[0]) / 3.0


def generalised_doubling() -> tuple[float, float]:
    """Return speed, rad/s, and amplitude, m, at which doubling turns from soft to hard."""
    speed = brentq(cubic_coefficient, *SPEEDS, xtol=1e-9)
    return speed, float(doubling(np.array([speed])).amplitude[0])
