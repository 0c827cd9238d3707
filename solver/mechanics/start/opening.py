"""Joints with play that start open, where what is given needs their play and is within it."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import applied
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.start.given import Given, Rows
from jointplay.solver.mechanics.start.levels import approach
from jointplay.solver.mechanics.start.places import KEPT, Places
from jointplay.solver.mechanics.start.pose import named_bodies
from jointplay.solver.scene.document import Scene


def opened(places: Places, guess: Floats, kept: Sequence[Given]) -> Floats | None:
    """Return the pose that keeps some of what is given with joints with play let go, if any does.

    They are as close as they come then with bodies of which nothing is given at the angles of the
    guess, and the rest of what is given is as near as that leaves. Whether that is within their
    play is not asked.
    """
    named = named_bodies(places.scene)
    free = [3 * i + 2 for i, body in enumerate(places.closed.bodies) if body not in named]
    turning = places.length * np.eye(len(guess))[free]
    rest = [one for one in places.given if one not in kept]

    def levels(pose: Floats) -> list[Rows]:
        return [
            places.constraints(places.loose, pose),
            places.wanted(kept, pose),
            Rows(applied(turning, pose - guess), turning),
            Rows(*arrays(places.slack(pose), len(pose))),
            places.wanted(rest, pose),
        ]

    found = approach(guess, levels, places.scale, 5)
    if places.is_closed(places.loose, found) and places.keeps(kept, found):
        return found
    return None


def opened_but_for_one(places: Places, scene: Scene, closed: Floats) -> Floats | None:
    """Return the pose within the play of a scene that keeps all that is given but for one value.

    The last one whose absence lets the others hold is left out. None where there is none, or the
    closed pose keeps as much: values that are read roughly from a drawing open no play.
    """
    for left_out in reversed(places.given):
        kept = [one for one in places.given if one is not left_out]
        if places.keeps(kept, closed):
            return None
        found = opened(places, closed, kept)
        if found is not None and within_play(places, scene, found):
            return found
    return None


def within_play(places: Places, scene: Scene, pose: Floats) -> bool:
    """Whether the joints with play that are let go are within it, of a scene with this geometry."""
    found: dict[str, dict[str, float]] = {}
    for row in places.slack(pose):
        found.setdefault(row.joint, {})[row.part] = float(row.value)
    return all(_is_within(scene, name, parts, places.length) for name, parts in found.items())


def _is_within(scene: Scene, name: str, parts: dict[str, float], length: float) -> bool:
    joint = scene.joints[name]
    return joint.is_within(parts, (joint.slack.play if joint.slack else 0.0) + KEPT * length)
