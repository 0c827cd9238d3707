"""Claims about friction that holds a joint: the slip stays on a ramp that no step resolves."""

from functools import partial
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

EXTREMES = Lie("press as a draft", "extremes were invented", lambda: by_extremes(DRAFT))
BARS = (
    *(
        Lie(
            f"slider-crank, friction full at {dynamic:g} m/s",
            "bars compared eight equal mistakes",
            partial(by_bars, _slider(dynamic), by_implicit_method),
        )
        for dynamic in (1e-5, 3e-5, 1e-4)
    ),
    Lie("press as a draft, its bars", "the same in all companions", lambda: by_bars(DRAFT)),
)
LIES = (*BARS, EXTREMES)
