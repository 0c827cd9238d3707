"""Curves that the joints of a scene are drawn by, as stores and the service give them."""

from collections.abc import Mapping
from typing import Any

from jointplay.solver.joints.joint import Joint


def joint_curves(joints: Mapping[str, Joint]) -> list[dict[str, Any]]:
    """Return the curves of joints as JSON has them.

    Each has the name of its `joint`, the point `about` which it is given, as `body.point`, whether
    it is `filled`, and its `points`, (n, 2) m from there in the body's axes.
    """
    return [
        {
            "joint": name,
            "about": joint.points[curve.end],
            "filled": curve.filled,
            "points": curve.points.tolist(),
        }
        for name, joint in joints.items()
        for curve in joint.curves()
    ]
