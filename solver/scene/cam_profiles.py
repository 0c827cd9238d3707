"""Checks of cams: a profile repeats after a turn, is smooth, and can be followed."""

import math
from collections.abc import Iterator

import numpy as np

from jointplay.records.failure import Problem
from jointplay.solver.scene.cams import CamJoint, FlatFollower, RollerFollower
from jointplay.solver.scene.document import Scene

SAMPLES = 720
"""Angles of a turn at which a profile is looked at."""
WHOLE = 1e-9
"""Mismatch within which a turn is a whole number of a profile's periods."""


def cam_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong with the profiles of cams; pointers begin at the scene."""
    for name, joint in scene.joints.items():
        if not isinstance(joint, CamJoint):
            continue
        if not any(rule.broken(joint.profile) for rule in joint.profile.rules):
            yield from _profile(f"/joints/{name}", joint)


def _profile(place: str, joint: CamJoint) -> Iterator[Problem]:
    profile = joint.profile
    if not profile.has_curvature:
        yield Problem(
            f"{place}/profile/between",
            "A follower needs a bounded acceleration that varies smoothly; give 'smooth'.",
        )
        return
    if not _repeats(profile.period):
        yield Problem(
            f"{place}/profile",
            f"A profile repeats every turn of its cam, 2 pi rad; this one repeats after"
            f" {profile.period:g}. Give a periodic one, as a table from 0 to 6.283185307179586.",
        )
        return
    angles = np.linspace(0.0, 2.0 * math.pi, SAMPLES, endpoint=False)
    value, slope, curvature = (np.broadcast_to(part, angles.shape) for part in profile.at(angles))
    lowest = int(value.argmin())
    if value[lowest] <= 0.0:
        yield Problem(
            f"{place}/profile",
            f"The profile is {value[lowest]:.4g} m at {angles[lowest]:.3g} rad, but a follower"
            " keeps away from the cam's centre; add a base radius.",
        )
        return
    if isinstance(joint, FlatFollower):
        radius = value + curvature
        least = int(radius.argmin())
        if radius[least] <= 0.0:
            yield Problem(
                f"{place}/profile",
                f"At {angles[least]:.3g} rad the cam is not convex (radius of curvature"
                f" {radius[least]:.4g} m), so that a flat face does not reach it; enlarge the base"
                " radius, or lift more slowly.",
            )
    elif isinstance(joint, RollerFollower):
        bends = value**2 + 2.0 * slope**2 - value * curvature
        bends /= (value**2 + slope**2) ** 1.5
        most = int(bends.argmax())
        if bends[most] * joint.roller_radius >= 1.0:
            yield Problem(
                f"{place}/roller_radius",
                f"At {angles[most]:.3g} rad the path of the roller's centre has a radius of"
                f" {1.0 / bends[most]:.4g} m, within which a roller of {joint.roller_radius:g} m"
                " cuts the cam away; make it smaller, or enlarge the base radius.",
            )


def _repeats(period: float) -> bool:
    """Tell whether a turn is a whole number of periods, or nothing changes at all."""
    if period == 0.0:
        return True
    turns = 2.0 * math.pi / period
    return round(turns) > 0 and abs(turns - round(turns)) <= WHOLE
