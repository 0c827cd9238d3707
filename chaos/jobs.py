"""A seeded mix of jobs of every kind, each of some seconds of computing."""

import random
from typing import Any, Final

Document = dict[str, Any]
_PRESS: Final = "seven-bar-press"


def jobs_of(seed: int) -> list[Document]:
    """Return one job of each kind, with parameters drawn from a seed.

    They are few, so that each needs to be computed only once without disturbance.
    """
    drawn = random.Random(seed)  # noqa: S311 - repeatable on purpose
    clearance = round(drawn.uniform(2e-4, 8e-4), 7)
    friction = round(drawn.uniform(0.02, 0.1), 4)
    press = {"preset": _PRESS, "parameters": {"clearance": clearance, "friction": friction}}
    values = {"from": 2e-4, "to": 1e-3, "count": 16}
    return [
        {"kind": "simulate", "scene": press, "duration": 150.0},
        {"kind": "simulate", "scene": {"preset": "slider-crank"}, "duration": 4.0},
        {
            "kind": "bifurcation",
            "scene": {"preset": _PRESS, "parameters": {"friction": friction}},
            "parameter": "clearance",
            "values": values,
            "settle": 30,
            "record": 150,
        },
        {
            "kind": "sweep",
            "scene": {"preset": _PRESS, "parameters": {"friction": friction}},
            "grid": {"clearance": values},
            "periods": 60,
            "statistics": ["root_mean_square", "contact_share"],
        },
        {"kind": "poincare", "scene": press, "settle": 20, "record": 300},
        {"kind": "ensemble", "scene": press, "members": 12, "spread": 1e-6, "record": 100},
        {
            "kind": "accuracy-study",
            "scene": {"preset": "slider-crank"},
            "duration": 0.5,
            "methods": ["tsitouras", "dormand-prince-853"],
            "tolerances": [1e-4, 1e-6],
        },
    ]
