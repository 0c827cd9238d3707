"""Exponents of the double pendulum, against an integration that shares nothing with the solver.

    python -m benchmarks double_pendulum [--starts 8] [--seconds 400]

Two equal uniform rods of 1 m and 1 kg are released at rest near the level. Lagrange's equations of
their two angles are integrated by SciPy's DOP853 at 1e-10. A second trajectory beside each, set
back to a distance of 1e-7 every half second, tells the exponent (Benettin et al. 1980).
"""

import argparse
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from benchmarks.lies.named.exponents import indicators

GRAVITY = 9.81  # m/s²
APART, RENORMALISED = 1e-7, 0.5  # rad and rad/s; s
SPREAD = 1e-3  # rad, from one start to the next
TOLERANCE = 1e-10


def rates(_: float, state: NDArray[np.float64]) -> list[float]:
    """Return the rates of both rods' angles from the level and of their speeds.

    The kinetic energy of rods of length and mass 1 is 2/3 u² + 1/6 w² + 1/2 u w cos(a - b).
    """
    a, b, u, w = state
    coupling, turning = 0.5 * math.cos(a - b), 0.5 * math.sin(a - b)
    upper = -turning * w * w - 1.5 * GRAVITY * math.cos(a)
    lower = turning * u * u - 0.5 * GRAVITY * math.cos(b)
    determinant = 4.0 / 9.0 - coupling * coupling
    return [
        u,
        w,
        (upper / 3.0 - coupling * lower) / determinant,
        (4.0 / 3.0 * lower - coupling * upper) / determinant,
    ]


def advanced(state: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a state after the time between renormalisations."""
    span = (0.0, RENORMALISED)
    found = solve_ivp(rates, span, state, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE)
    end: NDArray[np.float64] = found.y[:, -1]
    return end


def independent(start: float, seconds: float) -> float:
    """Return the exponent of the trajectory from a common angle of both rods, 1/s."""
    state = np.array([start, start, 0.0, 0.0])
    beside = state + APART * np.array([0.0, 0.0, 0.6, 0.8])
    grown = 0.0
    for _ in range(round(seconds / RENORMALISED)):
        state, beside = advanced(state), advanced(beside)
        distance = float(np.linalg.norm(beside - state))
        grown += math.log(distance / APART)
        beside = state + (beside - state) * (APART / distance)
    return grown / seconds


def of_the_solver(start: float, seconds: float) -> float:
    """Return what a study finds for the same start, 1/s; about a section a second."""
    parameters = {"angle_upper": start, "angle_lower": start}
    job: dict[str, Any] = {
        "kind": "poincare",
        "scene": {"preset": "double-pendulum", "parameters": parameters},
        "section": {"channel": "upper.omega", "value": 0.0},
        "settle": 0,
        "record": round(seconds),
        "indicators": ["lyapunov"],
        "tolerance": TOLERANCE,
    }
    return indicators(job)["lyapunov"]


def main() -> None:
    """Print the exponents of each start and their means."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks double_pendulum")
    parser.add_argument("--starts", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=400.0)
    arguments = parser.parse_args()
    found = []
    print("start, rad    solver, 1/s    independent, 1/s")
    for start in SPREAD * np.arange(arguments.starts):
        pair = [of(float(start), arguments.seconds) for of in (of_the_solver, independent)]
        found.append(pair)
        print(f"{start:10.3f}{pair[0]:15.3f}{pair[1]:20.3f}", flush=True)
    means, spreads = np.mean(found, axis=0), np.std(found, axis=0, ddof=1)
    errors = spreads / math.sqrt(len(found))
    for name, mean, spread, error in zip(
        ("solver", "independent"), means, spreads, errors, strict=True
    ):
        print(f"{name}: {mean:.3f} ± {error:.3f} 1/s, one start ± {spread:.3f}")


if __name__ == "__main__":
    main()
