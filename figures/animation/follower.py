"""A follower on its cam, magnified where they touch, as they stand in the world."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from jointplay.figures import page
from jointplay.figures.animation.magnified import DEEPEST, GAP, WALL, arrow, shown, turned
from jointplay.figures.mechanism_cams import (
    ANGLES,
    cam_angle,
    mean_profile,
    profile_angle,
    surface,
)
from jointplay.figures.mechanism_geometry import Pose
from jointplay.figures.mechanism_marks import EDGE, TINTS
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import marks_of, play_of

ROLLER: Final = 1.0 - GAP
"""Radius of a roller; under a flat face the mean of the cam's profile is 1."""
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
        The scene document.
    columns
        (m,) values by channel; NaN where they were not computed.
    """

    QUANTITIES = ("penetration", "normal_force")

    def __init__(self, name: str, scene: Mapping[str, Any], columns: Mapping[str, Floats]) -> None:
        self._scene = scene
        self._joint = joint = scene["joints"][name]
        self._depth, self._force = (columns[f"{name}.{one}"] for one in self.QUANTITIES)
        self._lash = play_of(joint)
        self._deepest = max(float(np.nanmax(self._depth, initial=0.0)), 1e-9)
        self._strongest = float(np.nanmax(self._force, initial=0.0)) or 1.0
        cam = marks_of(joint)["cam"]
        self._is_flat = "face" in cam
        self._drawn = mean_profile(joint) if self._is_flat else joint[cam["roller"]] / ROLLER
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

    def draw(self, axes: page.Axes, at: int, pose: Pose) -> None:
        """Draw it at an instant, the place of the cam where they touch in the middle."""
        from matplotlib.patches import Circle

        angle = profile_angle(self._scene, self._joint, pose)
        outline, normals = surface(self._joint, angle + ANGLES)
        cam = turned(cam_angle(self._joint, pose), (outline - outline[:, :1]).T / self._drawn)
        away = turned(cam_angle(self._joint, pose), normals[:, 0])
        tip = self.apart(at) * away
        axes.fill(*cam.T, facecolor=WALL, edgecolor=EDGE, linewidth=0.8, zorder=1)
        look: page.Look = {"facecolor": TINTS[0], "edgecolor": EDGE, "linewidth": 0.8, "zorder": 3}
        if self._is_flat:
            along = _LONG * np.array([away[1], -away[0]])
            ends = [tip - along, tip + along]
            face = np.array([*ends, *(end + _THICK * away for end in ends[::-1])])
            axes.fill(*face.T, **look)
        else:
            axes.add_patch(Circle(tuple(tip + ROLLER * away), ROLLER, **look))
        arrow(axes, tip, -away, self.force(at) / self._strongest)
