"""Guides with play: the walls that a slider has room between, and the slider itself; wide slots."""

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
_VISIBLE = 0.02
"""Play of a pin in extents of the mechanism from which on the walls of its slot are drawn."""
_STOP = 0.2
"""Length of these walls, in the same, or in their distance where that is more."""
_CORNERS = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])


@dataclass(frozen=True)
class Guide:
    """A slider between two walls, in the world; its tilt, within its play, is too small to see."""

    body: str
    slider: Floats
    """(4, 2) corners, m; (0, 2) of a pin, which is drawn as a joint."""
    walls: Floats
    """(2, 2, 2) both ends of each wall, m."""


def guides(scene: Mapping[str, Any], pose: Pose, extent: float) -> list[Guide]:
    """Place the guides with play of a scene whose mechanism has an extent [m]."""
    found = []
    for joint in scene["joints"].values():
        marks, play = marks_of(joint), play_of(joint)
        if marks["picture"] != "walls" or not play > 0.0:
            continue
        slider = joint[marks["ends"][1]]
        angle = heading(joint, pose)
        along = np.array([math.cos(angle), math.sin(angle)])
        across = np.array([-along[1], along[0]])
        if marks["block"] is None:
            if play > _VISIBLE * extent:
                wall = play + joint["clearance"][marks["size"]]
                half = 0.5 * _STOP * max(extent, 2.0 * wall)
                middle, _ = _on_the_axis(scene, pose, joint, along)
                walls = _walls(middle, half * along, wall * across)
                found.append(Guide(slider.partition(".")[0], np.empty((0, 2)), walls))
            continue
        length, height = (joint["clearance"][field] for field in marks["block"])
        larger = max(1.0, _SHORTEST * extent / length)
        half = 0.5 * larger * np.array([length, height])
        wall = half[1] + larger * play
        middle, centre = _on_the_axis(scene, pose, joint, along)
        corners = _CORNERS * half
        found.append(
            Guide(
                slider.partition(".")[0],
                centre + corners[:, :1] * along + corners[:, 1:] * across,
                _walls(middle, _WALLS * half[0] * along, wall * across),
            )
        )
    return found


def _on_the_axis(
    scene: Mapping[str, Any], pose: Pose, joint: Mapping[str, Any], along: Floats
) -> tuple[Floats, Floats]:
    """Return the point of the axis that is nearest to what slides, and the centre of that, m."""
    origin, centre = (np.array(world(scene, pose, joint[end])) for end in marks_of(joint)["ends"])
    return origin + along * ((centre - origin) @ along), centre


def _walls(middle: Floats, half: Floats, aside: Floats) -> Floats:
    """Return both ends of each wall; `half` leads to one of them, `aside` to the left wall."""
    ends = np.array([-1.0, 1.0])[:, None] * half
    return np.stack([middle + ends + side * aside for side in (1.0, -1.0)])


def draw_guides(axes: page.Axes, drawn: list[Guide], shape: Geometry, metre: float) -> None:
    """Draw the walls in the colour of clearances, and the slider between them."""
    named = any(joint.style == WITH_CLEARANCE for joint in shape.joints)
    for guide in drawn:
        style: page.Style = {"facecolor": colours.UNKNOWN, "edgecolor": EDGE, "linewidth": 0.6}
        if len(guide.slider):
            axes.fill(*(guide.slider.T / metre), **style, zorder=1.5)
        for wall in guide.walls:
            label = "_" if named else WITH_CLEARANCE
            style = {"color": colours.MARKED, "linewidth": 1.4, "zorder": 1.6}
            axes.plot(*(wall.T / metre), solid_capstyle="butt", label=label, **style)
            named = True
