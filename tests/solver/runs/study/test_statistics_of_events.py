"""Statistics of points whose sections are events: up to the last one, where the run ends."""

import math
from typing import Any

import numpy as np

from jointplay.solver.statistics import OF_CHANNELS, OF_CONTACTS
from tests.solver.runs.study.test_run import Computed

GRAVITY, CLEARANCE, STIFFNESS = 9.81, 5e-4, 1e6
"""m/s², m, N/m: a journal of 1 kg that falls from the centre and bounces for ever."""
ONSETS = 6


CHART: dict[str, Any] = {
    "kind": "chart",
    "scene": {
        "preset": "bouncing-journal",
        "parameters": {
            "restitution": 1.0,
            "friction": 0.0,
            "exponent": 1.0,
            "stiffness": STIFFNESS,
        },
    },
    "along": {"parameter": "clearance", "values": [CLEARANCE]},
    "by": {"parameter": "mass", "values": [1.0]},
    "section": {"onset": "bearing"},
    "settle": 0,
    "record": ONSETS,
    "indicators": [],
    "channels": ["journal.y"],
    "statistics": [*OF_CHANNELS, *OF_CONTACTS],
    "samples_per_period": 4096,
    "tolerance": 1e-9,
}


def test_they_are_of_the_time_until_the_last_event() -> None:
    """Free flight and a linear stiffness: half a flight, then whole bounces up to an onset."""
    speed, rate = math.sqrt(2.0 * GRAVITY * CLEARANCE), math.sqrt(STIFFNESS)
    half = speed / GRAVITY
    touching = 2.0 / rate * (math.pi - math.atan(rate * speed / GRAVITY))
    bounce = 2.0 * half + touching
    end = half + (ONSETS - 1) * bounce
    found = Computed(CHART).ends[0].statistics
    share = (ONSETS - 1) * touching / end
    # errors of the steps of six impacts
    assert math.isclose(found["bearing.contact_share"], share, rel_tol=1e-7)
    assert found["bearing.impacts"] == ONSETS
    since = (np.linspace(0.0, end, 100_001) + half) % bounce - half  # the last apex
    deep = np.maximum(since - half, 0.0) * rate
    depth = GRAVITY / STIFFNESS * (1.0 - np.cos(deep)) + speed / rate * np.sin(deep)
    height = np.where(since < half, -0.5 * GRAVITY * since**2, -CLEARANCE - depth)
    for name, level in (("quantile_05", 0.05), ("median", 0.5), ("quantile_95", 0.95)):
        expected = float(np.quantile(height, level))
        # of some 480 samples; one of them more below a level moves it by less
        assert math.isclose(found[f"journal.y.{name}"], expected, abs_tol=0.01 * CLEARANCE), name
