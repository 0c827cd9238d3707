"""Claims about friction that holds a joint: the slip stays on a ramp that no step resolves."""

from typing import Any

from benchmarks.lies.covered import by_implicit_method
from benchmarks.lies.named.lie import Lie, by_bars, by_extremes


def _slider(dynamic: float) -> dict[str, Any]:
    parameters = {"friction": 0.3, "static_velocity": 0.1 * dynamic, "dynamic_velocity": dynamic}
    scene = {"preset": "slider-crank", "parameters": parameters}
    return {"kind": "simulate", "scene": scene, "duration": 0.0065}


DRAFT = {
    "kind": "simulate",
    "scene": {
        "preset": "seven-bar-press",
        "parameters": {
            "speed": -1.185,
            "clearance_A": 2.01e-4,
            "clearance_B": 9.98e-4,
            "stiffness": 6.12e8,
            "restitution": 0.209,
            "friction": 0.292,
            "static_velocity": 1.61e-4,
            "dynamic_velocity": 1.887e-3,
            "bearing_radius": 0.0108,
        },
    },
    "duration": 0.06,
    "accuracy": "draft",
}

CROSSED = {
    "kind": "simulate",
    "scene": {
        "preset": "slider-crank",
        "parameters": {
            "clearance": 0.000262146,
            "bearing_radius": 0.00149831119176,
            "speed": 138.264,
            "stiffness": 1.05394e10,
            "restitution": 0.115051,
            "friction": 0.155791,
            "dynamic_velocity": 3.65389e-05,
            "static_velocity": 3.2885e-05,
        },
    },
    "duration": 0.0008,
    "method": "rodas",
    "tolerance": 3.72332e-07,
}

RAMP = Lie(
    "slider-crank, a ramp crossed twice in a step",
    "friction was small at both ends, and large between them",
    lambda: by_extremes(CROSSED),
)
EXTREMES = Lie("press as a draft", "extremes were invented", lambda: by_extremes(DRAFT))
BARS = (
    *(
        Lie(
            f"slider-crank, friction full at {dynamic:g} m/s",
            "bars compared eight equal mistakes",
            lambda dynamic=dynamic: by_bars(_slider(dynamic), by_implicit_method),
        )
        for dynamic in (1e-5, 3e-5, 1e-4)
    ),
    Lie("press as a draft, its bars", "the same in all companions", lambda: by_bars(DRAFT)),
)
LIES = (*BARS, RAMP, EXTREMES)
