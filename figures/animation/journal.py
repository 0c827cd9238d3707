"""A journal in its bearing, magnified, with the trail of its centre."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.animation.magnified import DEEPEST, GAP, WALL, arrow, deepest, shown
from jointplay.figures.mechanism_geometry import Pose
from jointplay.figures.mechanism_marks import EDGE, TINTS
from jointplay.records.arrays import Floats

_TRAIL = 240
"""Instants that a trail shows."""
_FADING = 4
_RING = 1.17


class Journal:
    """The picture of a revolute joint with play.

    Parameters
    ----------
    name
        Of the joint.
    scene
        The scene document.
    columns
        (m,) values by channel; NaN where they were not computed.
    """

    QUANTITIES = ("eccentricity_x", "eccentricity_y", "normal_force")

    def __init__(self, name: str, scene: Mapping[str, Any], columns: Mapping[str, Floats]) -> None:
        joint = scene["joints"][name]
        x, y, self._force = (columns[f"{name}.{one}"] for one in self.QUANTITIES)
        self._centre = np.stack([x, y], axis=1)
        self._play = float(joint["clearance"]["radial_clearance"])
        depth = np.hypot(x, y) - self._play
        self._deepest = deepest(depth)
        self._strongest = float(np.nanmax(self._force, initial=0.0)) or 1.0
        radius = float(joint["clearance"]["bearing_radius"])
        self.magnified = GAP * radius / self._play, DEEPEST * radius / self._deepest

    @staticmethod
    def channels(name: str, joint: Mapping[str, Any]) -> tuple[str, ...]:
        """Name what it is drawn from."""
        return tuple(f"{name}.{one}" for one in Journal.QUANTITIES)

    def force(self, at: int) -> float:
        """Give the normal force [N] at an instant."""
        return float(self._force[at])

    def draw(self, axes: page.Axes, at: int, pose: Pose) -> None:
        """Draw it at an instant."""
        from matplotlib.patches import Circle

        centre = self._position(at)
        for middle, radius, style in (
            ((0.0, 0.0), _RING, {"facecolor": WALL, "edgecolor": EDGE}),
            ((0.0, 0.0), 1.0, {"facecolor": "white", "edgecolor": EDGE}),
            (tuple(centre), 1.0 - GAP, {"facecolor": TINTS[0], "edgecolor": EDGE}),
            ((0.0, 0.0), GAP, {"fill": False, "edgecolor": colours.AUXILIARY}),
        ):
            axes.add_patch(Circle(middle, radius, linewidth=0.6, **style))
        first = max(at - _TRAIL, 0)
        trail = np.array([self._position(one) for one in range(first, at + 1)])
        for part in range(_FADING):
            low, high = (len(trail) * (part + more) // _FADING for more in (0, 1))
            axes.plot(
                *trail[low : high + 1].T,
                color=colours.COMPUTED,
                linewidth=0.7,
                alpha=0.25 + 0.75 * (part + 1) / _FADING,
                zorder=4,
            )
        axes.plot(*centre, "o", color=colours.COMPUTED, markersize=2.5, zorder=5)
        away = self._centre[at] / (math.hypot(*self._centre[at]) or 1.0)
        tip = centre + (1.0 - GAP) * away
        arrow(axes, tip, away, self.force(at) / self._strongest)

    def _position(self, at: int) -> Floats:
        """Return where the journal's centre is drawn at an instant."""
        distance = math.hypot(*self._centre[at])
        if distance == 0.0:
            return np.zeros(2)
        drawn = shown(distance, self._play, self._deepest)
        return np.asarray(self._centre[at] / distance * drawn)
