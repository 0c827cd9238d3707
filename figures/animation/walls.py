"""A slider in its guide, and a pin in its slot, magnified, as they stand in the world."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from jointplay.figures import page
from jointplay.figures.animation.magnified import DEEPEST, GAP, WALL, arrow, deepest, shown
from jointplay.figures.mechanism_geometry import Pose, heading, turned
from jointplay.figures.mechanism_marks import EDGE, TINTS
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import marks_of, play_of

_LEAST_HALF, _MOST_HALF = 0.3, 0.7
"""Half the height of a slider whose half length is 1."""
_THICK, _LONG = 0.17, 1.35
"""Thickness of a wall, and half its length."""


class BetweenWalls:
    """The picture of a prismatic joint, or of a pin in a slot, with play.

    Parameters
    ----------
    name
        Of the joint.
    scene
        The scene document.
    columns
        (m,) values by channel; NaN where they were not computed.
    """

    def __init__(self, name: str, scene: Mapping[str, Any], columns: Mapping[str, Floats]) -> None:
        joint = scene["joints"][name]
        marks, clearance = marks_of(joint), joint["clearance"]
        self._joint, parts = joint, marks["parts"]
        self._positions = np.array([*parts.values()])
        self._depth = np.stack([columns[f"{name}.{part}.penetration"] for part in parts])
        self._force = np.stack([columns[f"{name}.{part}.normal_force"] for part in parts])
        self._play = play_of(joint)
        self._deepest = deepest(self._depth)
        self._strongest = float(np.nanmax(self._force, initial=0.0)) or 1.0
        self._is_pin = marks["block"] is None
        if marks["block"] is None:
            size, self._half = clearance[marks["size"]], 1.0 - GAP
        else:
            length, height = (clearance[field] for field in marks["block"])
            size, slim = height / 2.0, height / length
            self._half = min(max(slim, _LEAST_HALF), _MOST_HALF)
        drawn = size / self._half
        self.magnified = GAP * drawn / self._play, DEEPEST * drawn / self._deepest

    @staticmethod
    def channels(name: str, joint: Mapping[str, Any]) -> tuple[str, ...]:
        """Name what it is drawn from."""
        parts = marks_of(joint)["parts"]
        return tuple(f"{name}.{p}.{one}" for p in parts for one in ("penetration", "normal_force"))

    def force(self, at: int) -> float:
        """Give the sum of the normal forces [N] at an instant."""
        return float(self._force[:, at].sum())

    def draw(self, axes: page.Axes, at: int, pose: Pose) -> None:
        """Draw it at an instant."""
        from matplotlib.patches import Circle

        angle = heading(self._joint, pose)
        inner = self._half + GAP
        band = [(-_LONG, inner), (_LONG, inner), (_LONG, inner + _THICK), (-_LONG, inner + _THICK)]
        for side in (1.0, -1.0):
            wall = turned(angle, np.array(band) * [1.0, side])
            axes.fill(*wall.T, facecolor=WALL, edgecolor="none", zorder=1)
            axes.plot(*wall[:2].T, color=EDGE, linewidth=0.8, zorder=2)
        touching = self.touching(at)
        style: page.Style = {
            "facecolor": TINTS[0],
            "edgecolor": EDGE,
            "linewidth": 0.8,
            "zorder": 3,
        }
        if self._is_pin:
            nearest = int(np.argmax(self._depth[:, at]))
            centre = touching[nearest] - self._half * self._positions[nearest]
            axes.add_patch(Circle(tuple(turned(angle, centre)), self._half, **style))
        else:
            axes.fill(*turned(angle, touching).T, **style)
        outwards = turned(angle, self._positions * [0.0, 1.0])
        for tip, normal, force in zip(
            turned(angle, touching), outwards, self._force[:, at], strict=True
        ):
            arrow(axes, tip, normal, force / self._strongest)

    def touching(self, at: int) -> Floats:
        """Return where corners, or a pin's sides, are drawn at an instant, along and across."""
        distances = (self._depth[:, at] + self._play).tolist()
        off = [shown(one, self._play, self._deepest) for one in distances]
        across = self._half + np.array(off)
        return np.asarray(self._positions * np.stack([np.ones(len(off)), across], axis=1))
