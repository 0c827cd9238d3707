"""Studies of contact pairs: a bead that bounces for ever between the walls of a slot."""

from typing import Any

import numpy as np
import pytest

from tests.solver.runs.study.test_run import Computed
from tests.solver.sliders import bead

SPEED, STIFFNESS, MASS = 0.5, 1e8, 1.0
PLAY: dict[str, Any] = {
    "help": "Clearance between the centred pin and either wall.",
    "unit": "m",
    "default": 1e-3,
    "targets": [{"path": "/joints/slot/clearance/wall_clearance"}],
}
SCENE = bead() | {"parameters": {"play": PLAY}}
LASTS = 2.9432750574 * (1.25 * MASS * SPEED**2 / STIFFNESS) ** 0.4 / SPEED
"""Duration of an impact at a spring of Hertz, s (Johnson 1985, eq. 11.24)."""


def cycle(clearance: float) -> float:
    """Return the time of an impact on both walls and of the ways between them, s."""
    return 4.0 * clearance / SPEED + 2.0 * LASTS


@pytest.mark.parametrize("clearance", [5e-4, 1e-3])
def test_statistics_are_those_of_each_wall(clearance: float) -> None:
    found = (
        Computed(
            {
                "kind": "sweep",
                "scene": SCENE,
                "points": [{"play": clearance}],
                "channels": ["slot.wall_1.normal_force"],
                "statistics": ["impacts", "contact_share"],
                "duration": 5.0 * cycle(clearance),
                "tolerance": 1e-8,
            }
        )
        .ends[0]
        .statistics
    )
    for wall in ("slot.wall_1", "slot.wall_2"):
        assert found[f"{wall}.impacts"] == 5
        # ten impacts at 1e-8 a step
        share = LASTS / cycle(clearance)
        assert found[f"{wall}.contact_share"] == pytest.approx(share, rel=1e-6)


def test_sections_are_taken_at_the_onsets_of_one_wall() -> None:
    found = Computed(
        {
            "kind": "poincare",
            "scene": SCENE,
            "section": {"onset": "slot.wall_2"},
            "record": 4,
            "settle": 0,
            "observables": ["bead.y", "bead.vy"],
            "tolerance": 1e-8,
        }
    )
    times = np.concatenate(found.times[0])
    np.testing.assert_allclose(np.diff(times), cycle(1e-3), rtol=1e-6)
