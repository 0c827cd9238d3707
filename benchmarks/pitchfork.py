"""The driven pendulum's loss of symmetry: a pitchfork, the branches beside it, and their doublings.

The motion is symmetric where half a period later it is its own mirror image. The map over half a
period, mirrored, has a multiplier -1 at the pitchfork, and orbit and strength are found at once by
shooting with another integrator.
"""

import time
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from benchmarks.known_orbits import DOUBLINGS, DRIVEN, NATURAL, followed, pendulum

SQUARE, DAMPING = NATURAL * NATURAL, NATURAL / 2.0
KNOWN = 1.00431947743
"""Strength at the pitchfork, by `shot`."""
JOB: dict[str, Any] = {
    "scene": pendulum(),
    "parameter": "strength",
    "values": {"from": 0.98, "to": 1.07, "count": 60},
    "settle": 100,
    "branch_points": 1,
    "tolerance": 1e-12,
}


def shot() -> float:
    """Return the strength at which the symmetric orbit has a multiplier 1."""

    def slope(strength: float, t: float, y: Any) -> list[float]:
        angle, rate = y[:2]
        tangents = y[2:].reshape(2, 2)
        bent = np.array([[0.0, 1.0], [-SQUARE * np.cos(angle), -DAMPING]])
        drive = strength * SQUARE * np.cos(DRIVEN * t)
        turned = drive - DAMPING * rate - SQUARE * np.sin(angle)
        return [rate, turned, *(bent @ tangents).ravel().tolist()]

    def away(unknown: Any) -> list[float]:
        angle, rate, strength = unknown
        end = solve_ivp(
            lambda t, y: slope(strength, t, y),
            (0.0, 0.5),
            [angle, rate, 1.0, 0.0, 0.0, 1.0],
            method="DOP853",
            rtol=1e-13,
            atol=1e-13,
        ).y[:, -1]
        test = np.linalg.det(np.eye(2) - end[2:].reshape(2, 2))
        return [end[0] + angle, end[1] + rate, float(test)]

    return float(root(away, [-1.07, 17.9, 1.004], tol=1e-13).x[2])


def main() -> None:
    """Print the pitchfork, and the doubling on each of the branches that begin there."""
    begun = time.process_time()
    first, other = followed(JOB)
    (point,) = [one for one in first.special if one.label == "BP"]
    known = shot()
    print(f"pitchfork {point.value:.11f} +- {point.bound:.0e}  known {known:.11f}", end="")
    print(f"  apart {point.value - known:.0e}")
    for one in other.special:
        if one.label == "PD":
            print(f"doubling {one.value:.11f} +- {one.bound:.0e}  known {DOUBLINGS[0]}", end="")
            print(f"  apart {one.value - DOUBLINGS[0]:.0e}")
    print(f"{time.process_time() - begun:.1f} s of one core")


if __name__ == "__main__":
    main()
