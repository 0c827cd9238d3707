"""Curves that joints are drawn by, placed in the world: outlines of cams, faces, rollers."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from jointplay.figures import page
from jointplay.figures.mechanism_geometry import Pose, angle_of, turned, world
from jointplay.figures.mechanism_marks import EDGE
from jointplay.records.arrays import Floats


class Curve(NamedTuple):
    """A curve in the world."""

    points: Floats
    """(n, 2) m."""
    filled: bool
    """Whether it is the outline of something."""


def curves(scene: Mapping[str, Any], pose: Pose) -> list[Curve]:
    """Place the curves of a scene; one that has none stored is drawn without."""
    return [
        Curve(
            turned(angle_of(pose, one["about"]), np.array(one["points"]))
            + world(scene, pose, one["about"]),
            one["filled"],
        )
        for one in scene.get("curves", ())
    ]


def draw_curves(axes: page.Axes, drawn: list[Curve], metre: float) -> None:
    """Draw outlines as faces with an edge, and other curves as lines."""
    for points, filled in drawn:
        x, y = points.T / metre
        if filled:
            axes.fill(x, y, facecolor="#DDDDDD", edgecolor=EDGE, linewidth=0.8, zorder=1)
        else:
            axes.plot(x, y, color=EDGE, linewidth=1.2, zorder=3)
