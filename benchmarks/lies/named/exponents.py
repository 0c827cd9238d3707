"""Claims about exponents where contact is hard and rare: a few steps an impact."""

import math
from typing import Any

from benchmarks.lies.named.lie import Found, Lie
from jointplay.solver.kinds import Study, admit
from jointplay.solver.nonlinear.estimate import SIGNIFICANT
from jointplay.solver.runs.study.run import StudyRun

SPEED = 60.0 * math.pi
"""rad/s, of the shaker."""
PHASE = 1.0986
"""rad, at which a ball that returns every turn is hit."""
SHAKEN = 3.037e-4
"""m."""
PIT = 0.05
"""m, the radial clearance."""


def bouncing_ball() -> dict[str, Any]:
    """Return a ball in a pit that shakes: it is hit once a turn, always the same way."""
    rise = 0.5 * 9.81 * 2.0 * math.pi / SPEED
    return {
        "name": "ball",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "shaker": {
                "mass": 1.0,
                "inertia": 1e-3,
                "points": {"pivot": [0.0, 0.0], "seat": [SHAKEN, 0.0]},
            },
            "ball": {"mass": 1.0, "inertia": 10.0, "points": {"c": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "shaker.pivot"},
            "P": {
                "type": "revolute",
                "bearing": "shaker.seat",
                "journal": "ball.c",
                "clearance": {
                    "radial_clearance": PIT,
                    "bearing_radius": 0.06,
                    "contact": {"stiffness": 1e12, "restitution": 0.5},
                    "friction": {
                        "coefficient": 0.3,
                        "static_velocity": 0.0,
                        "dynamic_velocity": 1.0,
                    },
                },
            },
        },
        "drivers": {"motor": {"joint": "O", "position": PHASE, "speed": SPEED}},
        "start": {
            "angular_velocities": {"ball": 6.0 * SPEED},
            "velocities": {"ball": [0.0, rise]},
            "joints": {"P": {"eccentricity": [-SHAKEN * math.cos(PHASE), -0.999976 * PIT]}},
        },
    }


def job(scene: dict[str, Any], settle: int, record: int, **more: Any) -> dict[str, Any]:
    """Return a study of one point that looks for an exponent and a period."""
    indicators = ["lyapunov", "recurrence"]
    return {
        "kind": "poincare",
        "scene": scene,
        "settle": settle,
        "record": record,
        "indicators": indicators,
        **more,
    }


def indicators(document: dict[str, Any]) -> dict[str, float]:
    """Return what a study of one point finds."""
    study = admit(document)
    assert isinstance(study, Study)
    ends = [end for piece in StudyRun(study, 0).slices() for end in piece.ended]
    return dict(ends[0].indicators)


def _holds(document: dict[str, Any], truth: float) -> Found:
    """Judge whether the truth, 1/s, is within three errors of the exponent."""
    found = indicators(document)
    value, error = found["lyapunov"], found["lyapunov_error"]
    return Found(abs(value - truth) <= SIGNIFICANT * error, f"{value:.3g} +- {error:.2g} 1/s")


HARD = {"speed": 30.0, "stiffness": 1e12, "clearance": 5e-3, "friction": 0.01}

LIES = (
    *(
        Lie(
            f"ball that is hit once a turn, {tolerance:g}",
            "the steps made an exponent",  # of two trajectories: the spin's, that falls like 1/t
            lambda tolerance=tolerance: _holds(
                job(bouncing_ball(), 200, 100, tolerance=tolerance), 0.0
            ),
        )
        for tolerance in (1e-5, 1e-6)
    ),
    *(
        Lie(
            f"slider-crank with hard contact, {tolerance:g}",
            "the steps made half of an exponent",
            lambda tolerance=tolerance: _holds(
                job({"preset": "slider-crank", "parameters": HARD}, 30, 60, tolerance=tolerance),
                25.0,
            ),
        )
        for tolerance in (1e-6, 1e-8)
    ),
)
