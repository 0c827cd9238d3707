"""Guides with play: the walls that a slider has room between, and the slider itself."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.mechanism_geometry import WITH_CLEARANCE, Geometry, Pose, heading, world
from jointplay.figures.mechanism_marks import EDGE
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import marks_of, play_of

_SHORTEST = 0.1
"""Length of a slider in extents of the mechanism: shorter ones are drawn larger."""
_WALLS = 2.2
"""Length of the walls in lengths of the slider."""
_CORNERS = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])


@dataclass(frozen=True)
class Guide:
    """A slider between two walls, in the world; its tilt, within its play, is too small to see."""

    body: str
    slider: Floats
    """(4, 2) corners, m."""
    walls: Floats
    """(2, 2, 2) both ends of each wall, m."""


def guides(scene: Mapping[str, Any], pose: Pose, extent: float) -> list[Guide]:
    """Place the guides with play of a scene whose mechanism has an extent [m]."""
    found = []
    for joint in scene["joints"].values():
        marks, play = marks_of(joint), play_of(joint)
        if marks["block"] is None or not play > 0.0:
            continue
        length, height = (joint["clearance"][field] for field in marks["block"])
        guide, slider = (joint[end] for end in marks["ends"])
        angle = heading(joint, pose)
        along = np.array([math.cos(angle), math.sin(angle)])
        across = np.array([-along[1], along[0]])
        larger = max(1.0, _SHORTEST * extent / length)
        half = 0.5 * larger * np.array([length, height])
        wall = half[1] + larger * play
        origin = np.array(world(scene, pose, guide))
        centre = np.array(world(scene, pose, slider))
        middle = origin + along * ((centre - origin) @ along)
        ends = np.array([-1.0, 1.0])[:, None] * _WALLS * half[0] * along
        corners = _CORNERS * half
        found.append(
            Guide(
                slider.partition(".")[0],
                centre + corners[:, :1] * along + corners[:, 1:] * across,
                np.stack([middle + ends + side * wall * across for side in (1.0, -1.0)]),
            )
        )
    return found


def draw_guides(axes: page.Axes, drawn: list[Guide], shape: Geometry, metre: float) -> None:
    """Draw the walls in the colour of clearances, and the slider between them."""
    named = any(joint.look == WITH_CLEARANCE for joint in shape.joints)
    for guide in drawn:
        axes.fill(
            *(guide.slider.T / metre),
            facecolor=colours.UNKNOWN,
            edgecolor=EDGE,
            linewidth=0.6,
            zorder=1.5,
        )
        for wall in guide.walls:
            label = "_" if named else WITH_CLEARANCE
            look: page.Look = {"color": colours.MARKED, "linewidth": 1.4, "zorder": 1.6}
            axes.plot(*(wall.T / metre), solid_capstyle="butt", label=label, **look)
            named = True
