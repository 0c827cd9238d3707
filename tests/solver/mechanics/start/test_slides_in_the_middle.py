"""A slide of which nothing says where it is begins at the point of its guide, on any body."""

import math
from typing import Any

import numpy as np
import pytest

from tests.solver.mechanics.start.mechanisms import ELASTIC, bar, put_together, revolute

GUIDE = [0.03, 0.05]
SLIDES: dict[str, dict[str, Any]] = {
    "slide": {"type": "prismatic", "guide": "rod.G", "slider": "block.a", "axis": [1, 0.3]},
    "pin in a slot": {"type": "pin-in-slot", "slot": "rod.G", "pin": "block.a", "axis": [1, 0.3]},
}
PLAY = {"wall_clearance": 1e-3, "length": 0.05, "height": 0.02, "contact": ELASTIC}
SLIDES["slide with play"] = SLIDES["slide"] | {"clearance": PLAY}


def on_a_rod(slide: dict[str, Any], start: dict[str, Any]) -> dict[str, Any]:
    """Return a four-bar, driven at 0.9 rad, whose rod carries a slide."""
    return {
        "name": "four-bar",
        "ground": {"points": {"O": [0, 0], "C": [0.4, 0]}},
        "bodies": {
            "crank": bar(0.05),
            "rod": {"mass": 1.0, "inertia": 0.1, "points": bar(0.2)["points"] | {"G": GUIDE}},
            "rocker": bar(0.125),
            "block": bar(0.02),
        },
        "joints": {
            "A": revolute("ground.O", "crank.a"),
            "B": revolute("crank.b", "rod.a"),
            "C": revolute("rod.b", "rocker.b"),
            "D": revolute("ground.C", "rocker.a"),
            "slide": slide,
        },
        "drivers": {"motor": {"joint": "A", "position": 0.9, "speed": 5.0}},
        "start": start,
    }


def away(pose: dict[str, Any]) -> float:
    """Return the distance of the block's point from the guide's, m."""
    positions = []
    for body, (x, y) in (("rod", GUIDE), ("block", (-0.02, 0.0))):
        px, py, angle = pose[body]
        c, s = math.cos(angle), math.sin(angle)
        positions.append((px + c * x - s * y, py + s * x + c * y))
    return math.dist(*positions)


@pytest.mark.parametrize("kind", SLIDES)
def test_a_slide_on_a_rod_begins_at_the_point_of_its_guide(kind: str) -> None:
    """Closing the four-bar turned its rod by 0.44 rad, and left the block 77 mm from there."""
    found, pose, _ = put_together(on_a_rod(SLIDES[kind], {}))
    assert found.residual < 1e-12
    assert abs(pose["rod"][2]) > 0.3
    assert away(pose) < 1e-12


def test_a_slide_stays_where_a_point_says() -> None:
    _, pose, _ = put_together(on_a_rod(SLIDES["slide"], {}))
    angle, shift = pose["rod"][2] + math.atan(0.3), 0.05
    moved = [shift * math.cos(angle), shift * math.sin(angle)]
    x, y, turned = pose["block"]
    position = np.array([x - 0.02 * math.cos(turned), y - 0.02 * math.sin(turned)]) + moved
    _, there, _ = put_together(
        on_a_rod(SLIDES["slide"], {"points": {"block.a": position.tolist()}})
    )
    assert away(there) == pytest.approx(shift, abs=1e-9)
