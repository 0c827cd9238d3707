"""Joints with play that start open, where what is given needs their play and is within it."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import applied
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.start.demands import KEPT, Demands
from jointplay.solver.mechanics.start.given import Given, Rows
from jointplay.solver.mechanics.start.levels import approach
from jointplay.solver.scene.document import Scene


def opened(demands: Demands, guess: Floats, kept: Sequence[Given]) -> Floats | None:
    """Return the pose that keeps some of what is given with joints with play let go, if any does.

    They are as close as they come then with bodies of which nothing is given at the angles of the
    guess, and the rest of what is given is as near as that leaves. Whether that is within their
    play is not asked.
    """
    free = demands.free_angles
    turning = demands.length * np.eye(len(guess))[free]
    rest = [one for one in demands.given if one not in kept]

    def levels(pose: Floats) -> list[Rows]:
        return [
            demands.constraints(demands.loose, pose),
            demands.wanted(kept, pose),
            Rows(applied(turning, pose - guess), turning),
            Rows(*arrays(demands.slack(pose), len(pose))),
            demands.wanted(rest, pose),
        ]

    found = approach(guess, levels, demands.scale, 5)
    if demands.is_closed(demands.loose, found) and demands.keeps(kept, found):
        return found
    return None


def opened_but_for_one(demands: Demands, scene: Scene, closed: Floats) -> Floats | None:
    """Return the pose within the play of a scene that keeps all that is given but for one value.

    The last one whose absence lets the others hold is left out. None where there is none, or the
    closed pose keeps as much: values that are read roughly from a drawing open no play.
    """
    for left_out in reversed(demands.given):
        kept = [one for one in demands.given if one is not left_out]
        if demands.keeps(kept, closed):
            return None
        found = opened(demands, closed, kept)
        if found is not None and within_play(demands, scene, found):
            return found
    return None


def within_play(demands: Demands, scene: Scene, pose: Floats) -> bool:
    """Whether the joints with play that are let go are within it, of a scene with this geometry."""
    found: dict[str, dict[str, float]] = {}
    for row in demands.slack(pose):
        found.setdefault(row.joint, {})[row.part] = float(row.value)
    return all(_is_within(scene, name, parts, demands.length) for name, parts in found.items())


def _is_within(scene: Scene, name: str, parts: dict[str, float], length: float) -> bool:
    joint = scene.joints[name]
    return joint.is_within(parts, (joint.slack.play if joint.slack else 0.0) + KEPT * length)
