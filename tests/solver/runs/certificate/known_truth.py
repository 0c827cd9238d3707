"""Cases whose true error a run at a far smaller tolerance tells, and how much of it is covered."""

import sys
from typing import Any, NamedTuple

import numpy as np

from benchmarks.extreme_cases import Coverage, coverage_of
from tests.solver.completed_runs import CASE_3


class Case(NamedTuple):
    """A preset with parameters, s, tolerance."""

    preset: str
    duration: float
    tolerance: float
    parameters: dict[str, Any]
    formulation: str = "reduced"


def _press(duration: float, tolerance: float, **parameters: Any) -> Case:
    return Case("seven-bar-press", duration, tolerance, CASE_3 | parameters)


def _slider(duration: float, tolerance: float, **parameters: Any) -> Case:
    return Case("slider-crank", duration, tolerance, parameters)


def _journal(duration: float, tolerance: float, **parameters: Any) -> Case:
    return Case("bouncing-journal", duration, tolerance, parameters)


CASES = {
    "press as shipped": Case("seven-bar-press", 0.2, 1e-6, {}),
    "press as shipped, loose": Case("seven-bar-press", 0.1, 1e-5, {}),
    "press as shipped, tight": Case("seven-bar-press", 0.2, 1e-8, {}),
    "press as shipped, half a turn": Case("seven-bar-press", 1.0, 1e-7, {}),
    "press, eq. 9, wide bearings": Case(
        "seven-bar-press",
        0.3,
        1e-6,
        {
            "bearing_radius": 0.01,
            "friction": 0.1,
            "static_velocity": 1e-3,
            "dynamic_velocity": 1e-2,
        },
    ),
    "press": _press(0.3, 1e-6),
    "press, a turn": _press(2.0, 1e-6),
    "press, loose": _press(0.3, 1e-5),
    "press, tighter": _press(0.3, 1e-7),
    "press, tight": _press(0.3, 1e-8),
    "press, very tight": _press(0.2, 1e-9),
    "press, 0.1 mm": _press(0.2, 1e-6, clearance=1e-4),
    "press, 0.2 mm": _press(0.2, 1e-6, clearance=2e-4),
    "press, 0.3 mm": _press(0.3, 1e-7, clearance=3e-4, friction=0.01),
    "press, 1 mm": _press(0.3, 1e-6, clearance=1e-3),
    "press, unequal clearances": _press(0.3, 1e-6, clearance_A=2e-4, clearance_B=6e-4),
    "press, little friction": _press(0.3, 1e-6, friction=0.02),
    "press, little friction, tight": _press(0.3, 1e-8, friction=0.02),
    "press, much friction": _press(0.3, 1e-6, friction=0.3),
    "press, dull impacts": _press(0.3, 1e-6, restitution=0.3),
    "press, hard": _press(0.2, 1e-6, stiffness=5e10),
    "press, soft": _press(0.3, 1e-6, stiffness=5e8),
    "press, 5 rad/s": _press(0.3, 1e-7, speed=5.0),
    "press, 7.85 rad/s": _press(0.3, 1e-6, speed=7.85),
    "press, 7.85 rad/s, tight": _press(0.3, 1e-8, speed=7.85),
    "press, 20 rad/s": _press(0.2, 1e-7, speed=20.0),
    "press, backwards": _press(0.2, 1e-6, speed=-5.0),
    "press, unequal speeds": _press(0.3, 1e-6, speed_crank4=6.0),
    "slider-crank": _slider(0.02, 1e-6),
    "slider-crank, tight": _slider(0.02, 1e-8),
    "slider-crank, a few turns": _slider(0.05, 1e-7),
    "slider-crank, 0.1 mm": _slider(0.02, 1e-6, clearance=1e-4),
    "slider-crank, much friction": _slider(0.02, 1e-7, friction=0.1),
    "slider-crank, slow": _slider(0.2, 1e-7, speed=30.0),
    "journal": _journal(0.5, 1e-6),
    "journal, tight": _journal(0.5, 1e-8),
    "journal, thrown and spinning": _journal(0.3, 1e-6, velocity_x=0.2, spin=20.0),
    "journal, dull": _journal(0.5, 1e-6, restitution=0.4, velocity_x=0.05),
    "pendulum": Case("pendulum", 3.0, 1e-6, {}),
    "pendulum, lagrange": Case("pendulum", 3.0, 1e-7, {"angle": 0.5}, "lagrange"),
}


def coverage(case: Case) -> Coverage:
    """Compare the estimated errors of a case with the true ones."""
    found = coverage_of(
        {
            "kind": "simulate",
            "scene": {"preset": case.preset, "parameters": case.parameters},
            "duration": case.duration,
            "tolerance": case.tolerance,
            "formulation": case.formulation,
        }
    )
    assert found is not None  # each has a reference
    return found


def report() -> str:
    """Return the coverage of all cases as a table."""
    found = {name: coverage(case) for name, case in CASES.items()}
    lines = ["case                                covered     known converged     ratio"]
    lines += [
        name.ljust(34) + "".join(f"{value:10.4f}" for value in one) for name, one in found.items()
    ]
    all_covered = [one.covered for one in found.values()]
    lines.append(f"covered: least {min(all_covered):.4f}, mean {np.mean(all_covered):.4f}")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.stdout.write(report() + "\n")
