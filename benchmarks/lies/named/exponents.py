"""Claims about exponents: of hard and rare contact, a few steps an impact, and of known motions."""

import math
from functools import partial
from typing import Any

from benchmarks.lies.named.lie import Found, Lie
from jointplay.solver.kinds import Study, admit
from jointplay.solver.nonlinear.estimate import SIGNIFICANT
from jointplay.solver.nonlinear.verdict import CHAOTIC, UNDECIDED, VERDICTS
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


def driven_pendulum(radius: float) -> dict[str, Any]:
    """Return a rod that hangs from the end of a crank (m), which turns at 6 rad/s."""
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"pin": [-0.5, 0.0]}}
    crank = {"mass": 1.0, "inertia": 0.01, "points": {"pin": [0.0, 0.0], "end": [radius, 0.0]}}
    return {
        "name": "driven-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"crank": crank, "rod": rod},
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.pin"},
            "P": {"type": "revolute", "bearing": "crank.end", "journal": "rod.pin"},
        },
        "drivers": {"motor": {"joint": "O", "position": 0.0, "speed": 6.0}},
        "start": {"angles": {"rod": -0.5 * math.pi}},
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


def _holds(document: dict[str, Any], truth: float, *, chaotic: bool, decided: bool = True) -> Found:
    """Judge whether the truth, 1/s, is within three errors, and whether chaos is called chaos.

    `decided` : whether the verdict on chaos must be one.
    """
    found = indicators(document)
    value, error, verdict = found["lyapunov"], found["lyapunov_error"], found["verdict"]
    called = verdict == CHAOTIC or (not decided and verdict == UNDECIDED)
    true = abs(value - truth) <= SIGNIFICANT * error and called == chaotic
    name = next(name for name, code in VERDICTS.items() if code == verdict)
    return Found(true, f"{value:.3g} +- {error:.2g} 1/s, {name}; truly {truth:g}")


FAST = {
    "preset": "seven-bar-press",
    "parameters": {
        "clearance": 5e-4,
        "bearing_radius": 1e-2,
        "stiffness": 5e9,
        "restitution": 0.7,
        "friction": 0.1,
        "static_velocity": 1e-3,
        "dynamic_velocity": 1e-2,
        "speed": 7.854,
        "speed_crank4": -7.854,
    },
}
HARD = {"speed": 30.0, "stiffness": 1e12, "clearance": 5e-3, "friction": 0.01}

LIES = (
    *(
        Lie(
            f"ball that is hit once a turn, {tolerance:g}",
            "the steps made an exponent",  # of two trajectories: the spin's, that falls like 1/t
            partial(
                _holds,
                job(bouncing_ball(), 200, 100, tolerance=tolerance),
                0.0,
                chaotic=False,
            ),
        )
        for tolerance in (1e-5, 1e-6, 1e-8)
    ),
    *(
        Lie(
            f"slider-crank with hard contact, {tolerance:g}",
            "the steps made half of an exponent",
            partial(
                _holds,
                job({"preset": "slider-crank", "parameters": HARD}, 30, 60, tolerance=tolerance),
                29.0,  # 29.0 +- 0.7 over 5000 turns at 1e-8, 28.3 +- 1.1 over 3000 at 1e-10
                chaotic=True,
                decided=tolerance < 1e-6,  # at 1e-6 three of ten starts 3e-13 apart are undecided
            ),
        )
        for tolerance in (1e-6, 1e-8)
    ),
    Lie(
        "press with hard contact, 1e-05",
        "chatter of the steps was chaos",
        lambda: _holds(
            job(
                {"preset": "seven-bar-press", "parameters": {"stiffness": 1e13}},
                20,
                60,
                tolerance=1e-5,
            ),
            0.0,
            chaotic=False,
        ),
    ),
    Lie(
        "pendulum on a crank of 0.2 m",
        "nothing",  # 0.816 +- 0.004 by Runge and Kutta on its own equation, 20 000 turns
        lambda: _holds(job(driven_pendulum(0.2), 50, 400), 0.816, chaotic=True),
    ),
    Lie(
        "pendulum on a crank of 0.02 m",
        "nothing",  # swings a few degrees about a stable turn: on a torus
        lambda: _holds(job(driven_pendulum(0.02), 50, 400), 0.0, chaotic=False),
    ),
    Lie(
        "press at 2.5 pi rad/s",
        "nothing",  # 6.9 +- 0.1 over longer runs at tolerances down to 1e-11
        lambda: _holds(job(FAST, 20, 100), 6.9, chaotic=True),
    ),
)
