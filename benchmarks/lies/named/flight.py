"""Claims about free flight, where no error bounds a step."""

import math
from functools import partial
from typing import Any

import numpy as np

from benchmarks.lies.named.lie import Found, Lie, by_bars, by_extremes
from benchmarks.lies.run import Finished, finish
from benchmarks.lies.scenes.bearing import play, rotor_in_bearing
from benchmarks.lies.scenes.mechanisms import loose_slider_crank
from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.study.run import StudyRun

PASSING = {"preset": "bouncing-journal", "parameters": {"gravity_y": -1.0, "velocity_x": 0.3}}
LEVEL, TIME = -8.27e-4, 0.3
"""A penetration that a journal passes several times in that time, m and s."""


def _bearing(
    clearance: float, radius: float, restitution: float, friction: float
) -> dict[str, Any]:
    return {
        "radial_clearance": clearance,
        "bearing_radius": radius,
        "contact": {"stiffness": 1e9, "restitution": restitution},
        "friction": {"coefficient": friction},
    }


def _rotor(gravity: float, radius: float, spin: float) -> dict[str, Any]:
    body = {"mass": 1.0, "inertia": 1e-4, "points": {"pin": [2.8184e-4, 0.0]}}
    start = {
        "angular_velocities": {"rotor": spin},
        "velocities": {"rotor": [0.0134, 0.0609 if gravity else 0.0]},
        "joints": {"J": {"eccentricity": [-2.4e-5, -1.83e-5]}},
    }
    return rotor_in_bearing("rotor", gravity, body, _bearing(5e-4, radius, 0.9, 0.1), start)


def _two_motors(slow: float) -> dict[str, Any]:
    """Return a pin that turns inside a free ring, and a table that turns by itself."""
    return {
        "name": "ring",
        "ground": {"points": {"O": [0.0, 0.0], "T": [1.0, 0.0]}},
        "bodies": {
            "crank": {
                "mass": 0.3,
                "inertia": 1e-4,
                "points": {"O": [0.0, 0.0], "pin": [0.0, 0.0046]},
            },
            "ring": {"mass": 2.0, "inertia": 0.01, "points": {"eye": [0.0, 0.0]}},
            "table": {"mass": 1.0, "inertia": 0.01, "points": {"O": [0.0, 0.0], "tip": [0.2, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "T": {"type": "revolute", "bearing": "ground.T", "journal": "table.O"},
            "E": {
                "type": "revolute",
                "bearing": "ring.eye",
                "journal": "crank.pin",
                "clearance": _bearing(5e-3, 0.02, 0.6, 0.05),
            },
        },
        "drivers": {"motor": {"joint": "O", "speed": 300.0}, "slow": {"joint": "T", "speed": slow}},
        "start": {
            "velocities": {"ring": [0.05, 0.0]},
            "joints": {"E": {"eccentricity": [0.0, 0.0046]}},
        },
    }


def _job(scene: dict[str, Any], duration: float, **more: Any) -> dict[str, Any]:
    return {"kind": "simulate", "scene": scene, "duration": duration, **more}


def _every_passage() -> Found:
    """Judge whether a section is taken wherever the samples of the same run pass the level."""
    sampled = finish(_job(PASSING, TIME, output_step=1e-6, certificate=False))
    assert isinstance(sampled, Finished)
    penetration = sampled.samples[:, sampled.names.index("bearing.penetration")]
    passed = int(((penetration[:-1] < LEVEL) & (penetration[1:] >= LEVEL)).sum())
    study = admit(
        {
            "kind": "poincare",
            "scene": PASSING,
            "settle": 0,
            "record": passed,
            "section": {"channel": "bearing.penetration", "value": LEVEL, "direction": "up"},
        }
    )
    assert isinstance(study, Study)
    slices = list(StudyRun(study, 0).slices())
    times = np.concatenate([rows.time for piece in slices for rows in piece.rows])
    taken = int((times <= TIME).sum())
    return Found(taken == passed, f"{taken} sections where the samples pass {passed} times")


def _comes_to_its_end(job: dict[str, Any]) -> Found:
    found = finish(job, most_steps=math.inf)
    ended = "done" if isinstance(found, Finished) else found
    return Found(ended == "done", ended)


SPINNING = {"preset": "pendulum", "parameters": {"gravity_y": 0.0, "angular_velocity": 1000.0}}
FLYING = {
    "preset": "bouncing-journal",
    "parameters": {
        "velocity_x": 0.2,
        "position_x": -9e-4,
        "position_y": 1e-5,
        "gravity_y": 0.0,
        "friction": 0.1,
    },
}
FALLING = {
    "preset": "bouncing-journal",
    "parameters": {
        "clearance": 7.7e-4,
        "stiffness": 7.3e7,
        "velocity_x": -0.24,
        "velocity_y": -0.277,
        "spin": 20.0,
        "position_x": -4e-5,
        "position_y": 3.7e-4,
        "friction": 0.19,
    },
}
SLOW = {
    "preset": "seven-bar-press",
    "parameters": {"speed": 300.0, "speed_crank4": 0.3, "friction": 10.0},
}

WALKING = {
    "preset": "jansen-leg",
    "parameters": {
        "clearance": 5.19534483679e-05,
        "restitution": 0.569894113827,
        "friction": 0.1527255197,
        "speed": 0.69869309036,
    },
}

RETURNING = loose_slider_crank(
    (0.015360672023, 0.0738034017625362),
    0.566549694427,
    [
        play(
            0.00013216437370081868,
            0.0006116957109345007,
            (688617643.521, 0.293425899466),
            (0.10532522082, 0.0163968285482, 0.0081984142741),
        ),
        play(
            2.481700783935138e-05,
            0.0001191455820677523,
            (4438020896.43, 0.384486750705),
            (0.0621645962406, 1.72030496582e-05, 8.6015248291e-06),
        ),
    ],
    {"position": 2.81217723609, "speed": 7.79251479504},
)
"""A journal that has passed the centre turns and passes it again, all in one step."""
TURNED_BACK = Lie(
    "journal that comes back in a flight",
    "an extreme was missed at the second of two passages in a step",
    lambda: by_extremes(_job(RETURNING, 0.0230430681, method="tsitouras", tolerance=1.2137e-6)),
)

LIES = (
    Lie(
        "rotor on a level shaft",
        "an impact was missed",
        lambda: by_bars(_job(_rotor(-9.81, 0.05, 1000.0), 0.03)),
    ),
    Lie(
        "rotor on a vertical shaft",
        "an impact was missed",
        lambda: by_bars(_job(_rotor(0.0, 0.01, 2000.0), 0.06)),
    ),
    *(
        Lie(
            f"ring beside a table at {slow:g} rad/s",
            "an impact was missed",
            partial(by_bars, _job(_two_motors(slow), 0.1)),
        )
        for slow in (0.3, 3.0, 299.7)
    ),
    Lie(
        "rod spinning freely", "extremes were impossible", lambda: by_extremes(_job(SPINNING, 0.05))
    ),
    Lie(
        "journal flying past",
        "extremes in flight were missed and invented",
        lambda: by_extremes(_job(FLYING, 0.008)),
    ),
    Lie(
        "journal falling about",
        "extremes in flight were missed",
        lambda: by_extremes(_job(FALLING, 0.15)),
    ),
    Lie(
        "leg in a flight of one step",
        "an extreme before an onset was missed",
        lambda: by_extremes(_job(WALKING, 0.0125, method="tsitouras", tolerance=1.82687e-05)),
    ),
    TURNED_BACK,
    Lie("level passed in flight", "sections were missed", _every_passage),
    Lie(
        "motors at a ratio of a thousand",
        "the run failed where one at nearly the same ratio did not",
        lambda: _comes_to_its_end(_job(SLOW, 0.002, certificate=False)),
    ),
)
