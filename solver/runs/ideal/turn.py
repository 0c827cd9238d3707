"""Whether a driven mechanism turns through: where it jams in a turn of its drivers, or nearly."""

from typing import NamedTuple

from jointplay.records.failure import SimulationFailed
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble_closed, shortest_link
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.ideal.constraints import Constraints
from jointplay.solver.runs.ideal.dead_point import driven_to, locks, lost_at
from jointplay.solver.runs.ideal.margin import Margin, lacking, nearest
from jointplay.solver.runs.ideal.path import Path
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers_time import drivers_time
from jointplay.solver.scene.once_per_scene import once_per_scene
from jointplay.solver.scene.time_scales import quickest_driver

MOST_WORK = 40_000
"""Coordinates of all poses after which a check leaves off: seconds."""


class Turn(NamedTuple):
    """A driven mechanism, its play closed, over a turn of its drivers."""

    span: float
    """Time that the turn takes, s."""
    repeats: bool
    """Whether the drivers are back after it."""
    reached: float
    """Time up to which it was followed, s: less if it jams, or if that takes too many poses."""
    lost: SimulationFailed | None
    """The way in which it jams, if it does."""
    margin: Margin | None
    """Distance from a dead point where it is nearest; where it jams, what it lacks to go on."""
    agrees: bool
    """Whether its redundant constraints, if any, agree all the way."""


@once_per_scene
def turn(scene: Scene) -> Turn | None:
    """Return how far a mechanism turns; None where it moves freely, or its drivers stand."""
    found, length = assemble_closed(scene), shortest_link(scene)
    shown = drivers_time(scene, length)
    if found.freedom or found.residual > ASSEMBLED * length or shown is None:
        return None
    span, repeats = shown.seconds, shown.repeats
    path = Path(Constraints(scene), found.pose, min(quickest_driver(scene, length), span))
    most = MOST_WORK // max(len(found.pose), 20)
    whole = path.follow(span, most)
    if not path.end.consistent:
        return Turn(span, repeats, path.end.time, lost_at(path, scene), None, agrees=False)
    closing = spanning_tree(scene).closing
    if whole:
        return Turn(span, repeats, path.end.time, None, nearest(path, closing), agrees=True)
    if len(path.times) >= most:
        return Turn(span, repeats, path.end.time, None, None, agrees=True)
    lack = lacking(path, span, closing) if locks(path.end) else None
    return Turn(span, repeats, path.end.time, lost_at(path, scene), lack, agrees=True)


def in_words(scene: Scene, found: Turn) -> str:
    """Return what a turn came to, in a sentence or two."""
    near = found.margin
    there = driven_to(scene, near.time) if near else ""
    if found.lost is not None:
        short = (
            f" Joint '{near.joint}' is up to {near.size:.3g} m short, where {there}."
            if near
            else ""
        )
        return found.lost.detail + short
    if found.reached < found.span:
        return f"It is followed up to t = {found.reached:.6g} s, and goes through so far."
    way = "come round" if found.repeats else "show their motion"
    told = f"It goes through the {found.span:.6g} s in which its drivers {way}."
    if near is None:
        return told
    return (
        f"{told} It is nearest to a dead point where {there}: {near.size:.3g} m at joint"
        f" '{near.joint}' would make it one."
    )
