"""A follower on its cam, magnified where they touch, as they stand in the world."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from jointplay.figures import page
from jointplay.figures.animation.magnified import DEEPEST, GAP, WALL, arrow, deepest, shown
from jointplay.figures.mechanism_geometry import Pose, angle_of, turned, world
from jointplay.figures.mechanism_marks import EDGE, TINTS
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import play_of

ROLLER: Final = 1.0 - GAP
"""Radius of a roller; the scale of a flat face is that of half its length in the mechanism."""
FARTHEST: Final = 2.0 * GAP
"""A follower that has lifted off farther is drawn there, or it would leave the picture."""
_THICK, _LONG = 0.34, 1.35
"""Thickness of a face, and half its length."""


class Follower:
    """The picture of a cam and its follower with lash.

    Parameters
    ----------
    name
        Of the joint.
    scene
        The scene document, and its `curves`: of the joint the outline of the cam, whose points are
        uniform in the angle of the profile, and the face, two points, or the roller.
    columns
        (m,) values by channel; NaN where they were not computed.
    """

    QUANTITIES = ("penetration", "normal_force")

    def __init__(self, name: str, scene: Mapping[str, Any], columns: Mapping[str, Floats]) -> None:
        self._scene = scene
        self._depth, self._force = (columns[f"{name}.{one}"] for one in self.QUANTITIES)
        self._lash = play_of(scene["joints"][name])
        self._deepest = deepest(self._depth)
        self._strongest = float(np.nanmax(self._force, initial=0.0)) or 1.0
        cam, follower = (one for one in scene["curves"] if one["joint"] == name)
        self._ends = cam["about"], follower["about"]
        self._cam, self._moved = np.array(cam["points"]), np.array(follower["points"])
        self._is_flat = len(self._moved) == 2
        self._drawn = float(np.hypot(*self._moved[0])) / ROLLER
        self.magnified = (
            GAP * self._drawn / self._lash,
            DEEPEST * self._drawn / self._deepest,
        )

    @staticmethod
    def channels(name: str, joint: Mapping[str, Any]) -> tuple[str, ...]:
        """Name what it is drawn from."""
        return tuple(f"{name}.{one}" for one in Follower.QUANTITIES)

    def force(self, at: int) -> float:
        """Give the normal force [N] at an instant."""
        return float(self._force[at])

    def apart(self, at: int) -> float:
        """Return how far follower and cam are drawn apart at an instant; below zero in contact."""
        inside = shown(float(self._depth[at]) + self._lash, self._lash, self._deepest)
        return min(GAP - inside, FARTHEST)

    def touched(self, pose: Pose) -> tuple[Floats, Floats]:
        """Return where the cam is touched, (2,) m in its axes, and its normal there in the world.

        Between two points of the outline, the touched one moves from one to the other.
        """
        cam, follower = self._ends
        x, y = np.subtract(world(self._scene, pose, follower), world(self._scene, pose, cam))
        if self._is_flat:
            along = turned(angle_of(pose, follower), self._moved[1] - self._moved[0])
            x, y = along[1], -along[0]
        turn, angles = angle_of(pose, cam), np.linspace(0.0, 2.0 * np.pi, len(self._cam))
        at = np.arctan2(y, x) - turn + angles[1] * np.array([-1.0, 0.0, 1.0])
        near = [np.interp(at, angles, column, period=2.0 * np.pi) for column in self._cam.T]
        before, touched, after = np.transpose(near)
        along = turned(turn, after - before)
        return touched, np.array([along[1], -along[0]]) / np.hypot(*along)

    def draw(self, axes: page.Axes, at: int, pose: Pose) -> None:
        """Draw it at an instant, the point of the cam where they touch in the middle."""
        from matplotlib.patches import Circle

        touched, away = self.touched(pose)
        tip = self.apart(at) * away
        cam = turned(angle_of(pose, self._ends[0]), self._cam - touched) / self._drawn
        axes.fill(*cam.T, facecolor=WALL, edgecolor=EDGE, linewidth=0.8, zorder=1)
        style: page.Style = {
            "facecolor": TINTS[0],
            "edgecolor": EDGE,
            "linewidth": 0.8,
            "zorder": 3,
        }
        if self._is_flat:
            along = _LONG * np.array([away[1], -away[0]])
            ends = [tip - along, tip + along]
            face = np.array([*ends, *(end + _THICK * away for end in ends[::-1])])
            axes.fill(*face.T, **style)
        else:
            axes.add_patch(Circle(tuple(tip + ROLLER * away), ROLLER, **style))
        arrow(axes, tip, -away, self.force(at) / self._strongest)
