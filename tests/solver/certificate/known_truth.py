"""Cases whose true error a run at a far smaller tolerance tells, and how much of it is covered."""

from __future__ import annotations

import sys
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.certificate import converged
from solver.admission import admit
from solver.certificate.certificate import Certificate
from solver.certificate.instants import FIRST
from solver.simulate import Simulation
from tests.solver.completed_runs import CASE_3, Run, collect
from worker.certificates import appendix_of

Floats = NDArray[np.float64]

REFERENCE, COARSER = 1e-12, 4e-12
"""Tolerances of two references: where these differ by more than DOUBT of what is to be judged,
the truth is not known."""
DOUBT = 0.1
ROUNDING = 1e-10
"""Of a value: what a reference itself is off by, which for a constant is all there is."""


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


class Coverage(NamedTuple):
    """Of a case."""

    covered: float
    """Share of errors that the estimate covers, over channels and instants."""
    known: float
    """Share of errors within the converged spans of which the truth is known."""
    converged: float
    """Share of the instants."""
    ratio: float
    """Median of estimate by true error, where there is an error."""


def coverage(case: Case) -> Coverage:
    """Compare the estimated errors of a case with the true ones, at the certificate's instants."""
    own, certificate = _run(case, case.tolerance, certificate=True)
    assert certificate is not None
    index = np.round(certificate.time / (case.duration / (len(own.time) - 1))).astype(int)
    values, truth, doubtful = (
        np.stack([run[name][index] for name in run.samples], axis=1)
        for run in (own, *(_run(case, tolerance)[0] for tolerance in (REFERENCE, COARSER)))
    )
    within = converged(appendix_of(certificate), certificate.time)
    error, doubt = np.abs(values - truth)[within], np.abs(truth - doubtful)[within]
    estimate = certificate.error[within]
    known = doubt <= DOUBT * np.maximum(estimate, error) + ROUNDING * np.abs(truth[within])
    covered = error <= estimate + ROUNDING * np.abs(truth[within])
    told = known & (error > ROUNDING * np.abs(truth[within])) & (error > 0.0)
    ratio = float(np.median(estimate[told] / error[told])) if told.any() else np.nan
    return Coverage(float(covered[known].mean()), float(known.mean()), float(within.mean()), ratio)


def _run(
    case: Case, tolerance: float, *, certificate: bool = False
) -> tuple[Run, Certificate | None]:
    admission = admit(
        {
            "kind": "simulate",
            "scene": {"preset": case.preset, "parameters": case.parameters},
            "duration": case.duration,
            "tolerance": tolerance,
            "formulation": case.formulation,
            "certificate": certificate,
            "output_step": case.duration / FIRST / 16,
        }
    )
    simulation = Simulation(admission)
    run = collect(admission, list(simulation.slices()), simulation)
    return run, simulation.certificate()


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
