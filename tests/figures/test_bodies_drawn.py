"""Bodies in the picture of a mechanism: bars, blocks, and how far they reach."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay import figures
from jointplay.figures.mechanism_geometry import geometry

PIN = {"type": "revolute", "bearing": "ground.O", "journal": "bar.O"}
GUIDE = {"type": "prismatic", "guide": "ground.O", "slider": "bar.O", "axis": [0.0, 1.0]}


def scene(joint: dict[str, Any], points: dict[str, list[float]]) -> dict[str, Any]:
    """A body on the ground."""
    return {
        "ground": {"points": {"O": [0.0, 0.0], "far": [1.0, 0.0]}},
        "bodies": {"bar": {"points": points}},
        "joints": {"J": joint},
    }


@pytest.mark.parametrize(
    ("joint", "centre", "corners"),
    [
        (PIN, (0.0, -0.4), [(0.0, 0.0), (0.0, -0.4)]),
        (PIN, (0.0, 0.0), [(0.0, 0.0)]),
        (GUIDE, (0.0, -0.4), [(0.0, 0.0)]),
    ],
    ids=["a pendulum", "a disc", "a slider"],
)
def test_a_body_of_one_point_reaches_to_its_centre_of_mass_unless_it_slides(
    joint: dict[str, Any], centre: tuple[float, float], corners: list[tuple[float, float]]
) -> None:
    x, y = centre
    shape = geometry(scene(joint, {"O": [-x, -y]}), {"bar": (x, y, 0.0)})
    assert shape.corners_of("bar") == corners
    assert shape.is_block("bar") == (len(corners) == 1)


def test_three_points_in_a_line_are_a_bar_at_any_angle() -> None:
    bar = scene(PIN, {"O": [0.0, 0.0], "A": [0.15, 0.0], "B": [0.4, 0.0]})
    for angle in np.linspace(-math.pi, math.pi, 101):
        (x, y), (right, up) = sorted(geometry(bar, {"bar": (0.0, 0.0, angle)}).corners_of("bar"))
        assert math.hypot(right - x, up - y) == pytest.approx(0.4)


def test_the_name_of_a_block_stands_beside_its_rail() -> None:
    block = scene(GUIDE, {"O": [0.0, 0.0]})
    (axes,) = figures.draw_mechanism(block, {"bar": (0.0, 0.0, 0.0)}).axes
    (name,) = [text for text in axes.texts if text.get_text() == "bar"]
    across, up = name.get_position()
    assert abs(across) > abs(up)
