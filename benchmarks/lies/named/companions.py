"""Claims about errors that companions shared, or that none of them had but the trajectory."""

from typing import Any

from benchmarks.lies.named.lie import Lie, by_bars


def _job(preset: str, duration: float, parameters: dict[str, Any], **more: Any) -> dict[str, Any]:
    scene = {"preset": preset, "parameters": parameters}
    return {"kind": "simulate", "scene": scene, "duration": duration} | more


UNLUCKY = _job(
    "seven-bar-press",
    0.0696,
    {
        "speed": 5.240681863043324,
        "clearance_A": 0.002576848336883217,
        "clearance_B": 0.0004562381566598047,
        "friction": 0.06854233794848655,
        "static_velocity": 1.2637953455150186e-05,
        "dynamic_velocity": 5.851878650053017e-05,
        "restitution": 0.5292228076303601,
        "stiffness": 74040865663.19919,
    },
    tolerance=8.94e-9,
)
LIMITED = _job("pendulum", 60.0, {"angle": 0.3}, method="bogacki-shampine", tolerance=1e-4)
RARE = _job("slider-crank", 0.02, {"stiffness": 1e12})
FIXED = _job("seven-bar-press", 0.1, {"friction": 0.1}, method="rk4", step=2e-5)

LIES = (
    Lie("press, an unlucky step", "no companion made it", lambda: by_bars(UNLUCKY)),
    Lie("pendulum at the longest step", "all companions made it", lambda: by_bars(LIMITED)),
    Lie("slider-crank, rare impacts", "bars of zero", lambda: by_bars(RARE)),
    Lie("press, fixed steps", "forces at onsets were off by 80 bars", lambda: by_bars(FIXED)),
)
