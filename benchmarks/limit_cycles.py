"""Orbits of mechanisms that nothing drives, whose periods and ends are known another way.

Lord Rayleigh's oscillator, whose speed is van der Pol's: its period by Taylor
series of order 30; one that two cycles leave where they meet, a fold; a mass on a
belt, whose friction has a constant value at rest and another one while it slides: sticking and
sliding in closed form; a pendulum that a torque keeps turning, up to where it comes to rest upside
down. Scenes have ramps of friction, whose width is extrapolated to zero.
"""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from benchmarks.basin_scenes import ON_THE_MASS, along_the_slide, pendulum, sliding
from benchmarks.known_orbits import followed

SHARP: dict[str, Any] = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15}
VAN_DER_POL = 6.66328685932313
"""s, at strength 1."""
RAMPS = 1.6e-3, 8e-4, 4e-4, 2e-4, 1e-4
"""m/s; over one of them friction of the belt grows, over the next it falls."""
POWERS = 0, 2, 3, 4, 5
"""Thirds, of the ramp, by which periods differ: friction is a smooth top, and passing such a fold
takes the power two thirds of its width (Mishchenko and Rozov 1980)."""
BELT, AT_REST, SLIDING = 0.1, 1.0, 0.5
"""m/s, N and N."""
PULL, DRAG = 1.0, 0.1
"""N m of the pendulum's weight, and N m s of its drag; its inertia is 1 kg m^2."""
SPRING = {"type": "spring-damper", **ON_THE_MASS, "stiffness": 1.0}


def over_speed(coefficients: list[float]) -> dict[str, Any]:
    """Return a force on the mass that is a polynomial of its speed."""
    return along_the_slide(coefficients) | {"over": {"quantity": "x", "rate": True}}


def varied(scene: dict[str, Any], path: str, value: float) -> dict[str, Any]:
    """Return a scene with the parameter `strength`."""
    one = {"help": "What varies.", "unit": "1", "default": value, "targets": [{"path": path}]}
    return scene | {"parameters": {"strength": one}}


def rayleigh() -> dict[str, Any]:
    """Return x'' = strength (x' - x'^3 / 3) - x."""
    push = over_speed([0.0, 1.0, 0.0, -1.0 / 3.0])
    return varied(sliding("rayleigh", 1e-13, spring=SPRING, push=push), "/forces/push/magnitude", 1)


def two_cycles() -> dict[str, Any]:
    """Return x'' = -strength x' + x'^3 - x'^5 - x: two cycles up to a fold."""
    push = over_speed([0.0, 0.0, 0.0, 1.0, 0.0, -1.0])
    scene = sliding("two-cycles", 0.15, spring=SPRING, push=push)
    return varied(scene, "/forces/damper/damping", 0.15)


def on_a_belt(ramp: float) -> dict[str, Any]:
    """Return a mass on a belt; friction at rest grows over a ramp, and falls over another."""
    slip = np.array([-1.0, -2.0 * ramp, -ramp, ramp, 2.0 * ramp, 1.0])
    values = [-SLIDING, -SLIDING, -AT_REST, AT_REST, SLIDING, SLIDING]
    rubbing = over_speed([]) | {
        "course": {
            "type": "table",
            "knots": (BELT - slip)[::-1].tolist(),
            "values": values[::-1],
            "outside": "held",
        }
    }
    scene = sliding("on-a-belt", 1e-13, spring=SPRING, rubbing=rubbing)
    return varied(scene, "/forces/spring/stiffness", 1.0)


def belt_period(stiffness: float) -> float:
    """Return the period of sticking and sliding, s, of 1 kg."""
    natural, drop = math.sqrt(stiffness), AT_REST - SLIDING
    sticks = 2.0 * drop / (stiffness * BELT)
    return sticks + 2.0 * (math.pi - math.atan(drop * natural / (stiffness * BELT))) / natural


def returns(slope: Callable[[float, Any], list[float]], speed: float) -> tuple[float, float]:
    """Return speed and time when a motion that starts at x = 0 comes back there from below."""

    def passes(_t: float, y: Any) -> float:
        return float(y[0])

    passes.direction, passes.terminal = 1.0, True  # type: ignore[attr-defined]
    found = solve_ivp(slope, (1e-9, 100.0), [1e-9 * speed, speed], events=passes, **SHARP)
    assert found.y_events is not None
    assert found.t_events is not None
    return float(found.y_events[0][0][1]), float(found.t_events[0][0])


def known_fold() -> float:
    """Return the damping at which both cycles of `two_cycles` meet.

    Each speed at x = 0 is that of a cycle for one damping, which is largest at the fold.
    """

    def damping(speed: float) -> float:
        def gain(c: float) -> float:
            def slope(_t: float, y: Any) -> list[float]:
                v = y[1]
                return [v, -c * v + v**3 - v**5 - y[0]]

            return returns(slope, speed)[0] - speed

        return brentq(gain, 0.1, 0.35, xtol=1e-14)

    speeds = np.linspace(0.72, 0.82, 9)
    fit = np.polynomial.Chebyshev.fit(speeds, [damping(one) for one in speeds], 8)
    tops = [
        one.real
        for one in np.asarray(fit.deriv().roots(), np.complex128)
        if abs(one.imag) < 1e-9 and 0.72 < one.real < 0.82
    ]
    return max(float(fit(one)) for one in tops)


def known_end() -> float:
    """Return the torque at which the turning pendulum comes to rest upside down.

    Energy over the angle: from the position of rest on, once round, back to it.
    """

    def short(push: float) -> float:
        rest = math.pi - math.asin(push / PULL) - 2.0 * math.pi
        rate = -0.5 * DRAG + math.sqrt(0.25 * DRAG**2 - math.cos(rest))

        def slope(angle: float, half: Any) -> list[float]:
            return [push - math.sin(angle) - DRAG * math.sqrt(max(2.0 * half[0], 0.0))]

        begin = 1e-6
        first = 0.5 * (rate * begin) ** 2
        found = solve_ivp(slope, (rest + begin, rest + 2.0 * math.pi - 1e-3), [first], **SHARP)
        fall = -0.5 * DRAG - math.sqrt(0.25 * DRAG**2 - math.cos(rest))
        return math.sqrt(2.0 * max(found.y[0, -1], 0.0)) + fall * 1e-3

    return brentq(short, 0.12, 0.14, xtol=1e-13)


def cycles() -> None:
    """Print the period of van der Pol's oscillator, the fold, and the pendulum's end."""
    section = {"channel": "mass.x", "value": 0.0}
    job = {"parameter": "strength", "section": section, "settle": 40, "tolerance": 1e-12}
    values = {"from": 1.0, "to": 4.0, "count": 100}
    (branch,) = followed(job | {"scene": rayleigh(), "values": values, "state": [0.0, 1.0]})
    period = float(branch.column("duration")[0])
    print(f"van der Pol: period {period:.12f} s  known {VAN_DER_POL:.12f}", end="")
    print(f"  apart {period - VAN_DER_POL:.0e}")
    values = {"from": 0.15, "to": 0.3, "count": 200}
    (branch,) = followed(job | {"scene": two_cycles(), "values": values, "state": [0.0, 0.9]})
    fold, known = next(one for one in branch.special if one.label == "LP"), known_fold()
    print(f"two cycles: fold {fold.value:.12f} +- {fold.bound:.0e}  known {known:.12f}", end="")
    print(f"  apart {fold.value - known:.0e}")
    values = {"from": 0.5, "to": 0.1, "count": 200}
    job |= {"scene": pendulum(), "parameter": "push", "values": values, "state": [0.0, 5.0]}
    job |= {"section": {"channel": "rod.theta", "value": 1.0}, "largest_step": 0.1}
    (branch,) = followed(job)
    length, multiplier = branch.column("duration"), branch.column("multiplier_1.real")
    apart = np.abs(multiplier - np.exp(-DRAG * length)) - branch.column("multiplier_error")
    end, known = branch.special[-1], known_end()
    print(
        f"turning pendulum: followed to a period of {length[-1]:.2f} s, at {end.value:.12f}", end=""
    )
    print(f"  known end {known:.12f}; multipliers beyond their bars at", end="")
    print(f" {np.count_nonzero(apart > 0.0)} of {len(length)} orbits")


def belt() -> None:
    """Print the periods of the mass on the belt for each ramp, and without any."""
    rows = []
    for ramp in RAMPS:
        values = {"from": 1.0, "to": 1.2, "count": 20}
        job = {"scene": on_a_belt(ramp), "parameter": "strength", "values": values, "settle": 20}
        section = {"channel": "mass.vx", "value": 0.0, "direction": "up"}
        (branch,) = followed(job | {"section": section, "state": [0.0, 0.05], "largest_step": 0.5})
        rows.append([float(branch.column("duration")[k]) for k in (0, -1)])
        print(f"    ramp {ramp}: {rows[-1]}")
    powers = np.array(RAMPS)[:, None] ** (np.array(POWERS) / 3.0)
    limit = np.linalg.solve(powers, np.array(rows))[0]
    for stiffness, found in zip((1.0, 1.2), limit, strict=True):
        known = belt_period(stiffness)
        print(f"belt, {stiffness} N/m: period {found:.8f} s  known {known:.10f}", end="")
        print(f"  apart {found - known:.0e}")


def main() -> None:
    """Print all."""
    for part in (cycles, belt):
        begun = time.process_time()
        part()
        print(f"{time.process_time() - begun:.1f} s of one core")


if __name__ == "__main__":
    main()
