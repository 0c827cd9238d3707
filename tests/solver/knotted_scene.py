"""Blocks on slides that functions with knots drive and push: of time, of place, one way only."""

from typing import Any

WAVE = {"type": "table", "between": "monotone", "outside": "held"}
PUSH = WAVE | {"knots": [0.0, 0.13, 0.2, 0.31, 0.5], "values": [0.0, 3.0, -2.0, 4.0, 0.0]}
"""Strength of a force over time, s."""
WELLS = WAVE | {
    "knots": [-0.5, -0.2, 0.0, 0.1, 0.3, 0.5],
    "values": [0.0, -3.0, 2.0, -4.0, 1.0, 0.0],
}
"""Strength of a force over a place, m."""
JERKED = {
    "type": "piecewise-polynomial",
    "knots": [0.0, 0.17, 0.29, 0.39],
    "coefficients": [[0.0, 0.0, 2.0], [0.0578, 0.68, -3.0], [0.0962, -0.04, 0.2]],
    "outside": "held",
}
"""Motion of a carrier, m, whose acceleration jumps."""
STIFFNESS, STEADY, FULL_RATE = 30.0, 1.0, 0.5
"""Values of the ball's spring, N/m, of what pulls it, N, and of what acts while it rises, m/s."""


def knotted_scene() -> dict[str, Any]:
    """Return a scene: a carrier, a block that slides on it, and a ball with a slide of its own."""
    origin = {"points": {"O": [0.0, 0.0]}}
    body = {"mass": 1.0, "inertia": 1.0} | origin
    slide = {"type": "prismatic", "axis": [1.0, 0.0]}
    on_block = {"first": "ground.O", "second": "block.O"}
    on_ball = {"first": "ground.O", "second": "ball.O"}
    force = {"type": "force", "magnitude": 1.0, "direction": [1.0, 0.0]}
    place = {"over": {"quantity": "x"}}
    return {
        "name": "knotted",
        "ground": origin,
        "bodies": {"carrier": body, "block": body, "ball": body},
        "joints": {
            "base": slide | {"guide": "ground.O", "slider": "carrier.O"},
            "top": slide | {"guide": "carrier.O", "slider": "block.O"},
            "own": slide | {"guide": "ground.O", "slider": "ball.O"},
        },
        "drivers": {"motor": {"joint": "base", "motion": JERKED}},
        "forces": {
            "push": force | on_block | {"course": PUSH},
            "wells": force | on_ball | place | {"course": WELLS},
            "kick": force | on_ball | place | {"only": "rising", "full_rate": FULL_RATE},
            "spring": {"type": "spring-damper", "stiffness": STIFFNESS} | on_ball,
        },
        "start": {"velocities": {"ball": [1.0, 0.0]}},
    }
