"""Outlines of cams, from the profiles of a scene document, with the faces and rollers they move."""

import math
from collections.abc import Mapping
from itertools import zip_longest
from typing import Any

import numpy as np

from jointplay.figures import page
from jointplay.figures.mechanism_geometry import GROUND, Pose, placed, world
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import marks_of, play_of

Curves = tuple[Floats | None, Floats | None]
"""Outline of a cam, if there is one, and a line."""
ANGLES = np.linspace(0.0, 2.0 * math.pi, 361)
_APART = 1e-4
"""Angle between the two values of a slope [rad]: errors of 1e-8 of a wave, rounding below 1e-11."""
_FACE = 0.6
"""Half the length of a face that is drawn, in means of the profile."""


def cam_curves(scene: Mapping[str, Any], pose: Pose) -> list[Curves]:
    """Return the outline of each cam with what it moves, and the circles that joints are drawn by.

    (2, points) m in the world.
    """
    found: list[Curves] = []
    for joint in scene["joints"].values():
        marks = marks_of(joint)
        ends, cam = [joint[end] for end in marks["ends"]], marks["cam"]
        outlines, moved = [], []
        if cam:
            outlines.append(_world(scene, pose, ends[0], surface(joint, ANGLES)[0]))
        if "face" in cam:
            x, y = joint[cam["face"]]
            across = np.array([-y, x]) / math.hypot(x, y) * _FACE * mean_profile(joint)
            moved.append(_world(scene, pose, ends[1], np.stack([-across, across], axis=1)))
        for end, radius in marks["circles"]:
            circle = joint[radius] * np.stack([np.cos(ANGLES), np.sin(ANGLES)])
            moved.append(_world(scene, pose, ends[end], circle))
        found += zip_longest(outlines, moved)
    return found


def surface(joint: Mapping[str, Any], angles: Floats) -> tuple[Floats, Floats]:
    """Return where a cam ends, (2, n) m about its centre, and the normals there, outwards.

    In the cam's axes; the follower, as it has the (n,) angles of the profile, touches it there.
    """
    lash, cam = play_of(joint), marks_of(joint)["cam"]
    value = _profile(joint[cam["profile"]], angles)
    slope = _slope(joint[cam["profile"]], angles)
    away = np.stack([np.cos(angles), np.sin(angles)])
    aside = np.stack([-np.sin(angles), np.cos(angles)])
    if "face" in cam:
        return (value - lash) * away + slope * aside, away
    normal = value * away - slope * aside
    normal = normal / np.hypot(*normal)
    return value * away - (joint[cam["roller"]] + lash) * normal, normal


def profile_angle(scene: Mapping[str, Any], joint: Mapping[str, Any], pose: Pose) -> float:
    """Return the angle of a follower in its cam's axes, which its profile is over [rad]."""
    marks = marks_of(joint)
    cam, follower = (str(joint[end]) for end in marks["ends"])
    if "face" in marks["cam"]:
        x, y = joint[marks["cam"]["face"]]
        turned = _angle(follower, pose)
    else:
        x, y = np.subtract(world(scene, pose, follower), world(scene, pose, cam)).tolist()
        turned = 0.0
    return math.atan2(y, x) + turned - _angle(cam, pose)


def cam_angle(joint: Mapping[str, Any], pose: Pose) -> float:
    """Return by what the axes of a cam are turned in the world [rad]."""
    return _angle(str(joint[marks_of(joint)["ends"][0]]), pose)


def mean_profile(joint: Mapping[str, Any]) -> float:
    """Return the mean of a cam's profile over a turn [m]."""
    return float(_profile(joint[marks_of(joint)["cam"]["profile"]], ANGLES[:-1]).mean())


def draw_cams(axes: page.Axes, curves: list[Curves], metre: float) -> None:
    """Draw cams as faces with an edge, and what they move, and circles, as lines."""
    look: page.Look = {
        "facecolor": "#DDDDDD",
        "edgecolor": "#404040",
        "linewidth": 0.8,
        "zorder": 1,
    }
    for outline, moved in curves:
        if outline is not None:
            axes.fill(*(outline / metre), **look)
        if moved is not None:
            axes.plot(*(moved / metre), color="#404040", linewidth=1.2, zorder=3)


def _world(scene: Mapping[str, Any], pose: Pose, reference: str, curve: Floats) -> Floats:
    """Place a curve about a body's point, (2, points) m in the body's axes, in the world."""
    body, point = reference.split(".")
    if body == GROUND:
        x, y = scene["ground"]["points"][point]
        return np.asarray(curve + np.array([[x], [y]]))
    x, y = scene["bodies"][body]["points"][point]
    there = [placed(pose[body], (x + dx, y + dy)) for dx, dy in curve.T.tolist()]
    return np.array(there).T


def _angle(reference: str, pose: Pose) -> float:
    body = reference.partition(".")[0]
    return 0.0 if body == GROUND else pose[body][2]


def _slope(function: Mapping[str, Any], angles: Floats) -> Floats:
    """Return the derivative of a profile by its angle, m/rad."""
    after, before = (_profile(function, angles + sign * _APART / 2.0) for sign in (1.0, -1.0))
    return np.asarray((after - before) / _APART)


def _profile(function: Mapping[str, Any], angles: Floats) -> Floats:
    """Evaluate the profile of a checked scene: those of its functions that repeat, m."""
    kind = function["type"]
    if kind == "sinusoidal":
        wave = np.sin(function["frequency"] * angles + function.get("phase", 0.0))
        return np.asarray(function.get("offset", 0.0) + function["amplitude"] * wave)
    if kind == "table":
        from scipy.interpolate import CubicSpline

        knots = np.array(function["knots"])
        spline = CubicSpline(knots, function["values"], bc_type="periodic")
        return np.asarray(spline(knots[0] + np.mod(angles - knots[0], knots[-1] - knots[0])))
    if kind == "piecewise-polynomial":
        knots = np.array(function["knots"])
        inside = knots[0] + np.mod(angles - knots[0], knots[-1] - knots[0])
        piece = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, len(knots) - 2)
        values = [
            np.polynomial.polynomial.polyval(x - knots[k], function["coefficients"][k])
            for x, k in zip(inside, piece, strict=True)
        ]
        return np.array(values)
    first = function.get("value", (function.get("coefficients") or [function.get("start", 0.0)])[0])
    return np.full_like(angles, first)
