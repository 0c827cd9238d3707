"""Channels of a study: what every point offers, what is kept unless the job says otherwise."""

import math
from collections.abc import Sequence

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.studies import PlacedPoints
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.tree import Branch, spanning_tree
from jointplay.solver.scene.channels import channels, select
from jointplay.solver.scene.document import Scene

RATES = {"x": "vx", "y": "vy", "theta": "omega"}
ECCENTRICITY = (
    "eccentricity_x",
    "eccentricity_y",
    "eccentricity_rate_x",
    "eccentricity_rate_y",
)
LOADS = ("normal_force", "penetration")


def shared_channels(checked: PlacedPoints) -> tuple[Channel, ...]:
    """Return the channels that every point offers: an ideal joint has no eccentricity."""
    offered = [channels(scene) for scene in checked.first_scenes.values()]
    shared = set.intersection(*({channel.name for channel in each} for each in offered))
    return tuple(channel for channel in offered[0] if channel.name in shared)


def chosen(
    checked: PlacedPoints, patterns: Sequence[str] | None, default: Sequence[str], pointer: str
) -> tuple[Channel, ...]:
    """Return the channels that a job names, else those of the default that every point offers.

    Raises
    ------
    InvalidInput
        A name or glob that matches nothing, or only what some points do not offer.
    """
    shared = shared_channels(checked)
    if patterns is None:
        return tuple(channel for channel in shared if channel.name in default)
    try:
        return select(shared, list(patterns), pointer)
    except InvalidInput as error:
        raise InvalidInput(
            _explained(checked, problem, patterns, pointer) for problem in error.problems
        ) from None


def coordinate_channels(checked: PlacedPoints) -> list[str]:
    """Return the generalised coordinates and eccentricities with their rates.

    Where points differ in their coordinates, those of the structure with most of them.
    """
    scene = max(checked.first_scenes.values(), key=lambda one: len(spanning_tree(one).coordinates))
    names = [name for both in coordinates_with_rates(scene) for name in both]
    pairs = spanning_tree(scene).pairs
    return names + [f"{pair}.{name}" for pair in pairs for name in ECCENTRICITY]


def coordinates_with_rates(scene: Scene) -> list[tuple[str, str]]:
    """Return the channels of each generalised coordinate and of its rate, in the tree's order."""
    found = []
    for branch in spanning_tree(scene).branches:
        for coordinate in branch.coordinates:
            body, kind = coordinate.split(".")
            kind = _direction(scene, branch) if kind == "s" else kind
            found.append((f"{body}.{kind}", f"{body}.{RATES[kind]}"))
    return found


def peak_channels(checked: PlacedPoints) -> list[str]:
    """Return the declared outputs, and the loads of each contact pair."""
    return [output.name for output in checked.declared.outputs] + [
        f"{pair}.{name}"
        for scene in checked.first_scenes.values()
        for pair in spanning_tree(scene).pairs
        for name in LOADS
    ]


def _direction(scene: Scene, branch: Branch) -> str:
    """Return the axis of the world to which a guide is closer as it stands at t = 0."""
    joint = scene.joints[branch.joint]
    if joint.heading is None:
        return "x"
    guide, _ = joint.bodies
    bodies = list(scene.bodies)
    turned = 0.0 if guide == "ground" else assemble(scene).pose[3 * bodies.index(guide) + 2]
    angle = math.atan2(joint.heading[1], joint.heading[0]) + float(turned)
    return "x" if abs(math.cos(angle)) >= abs(math.sin(angle)) * (1.0 - 1e-12) else "y"


def _explained(
    checked: PlacedPoints, problem: Problem, patterns: Sequence[str], pointer: str
) -> Problem:
    """Say of a channel that only some points offer which points lack it."""
    pattern = patterns[int(problem.pointer.removeprefix(f"{pointer}/"))]
    lacking = [
        point for point, scene in checked.first_scenes.items() if not _offers(scene, pattern)
    ]
    if len(lacking) == len(checked.first_scenes):
        return problem
    return Problem(
        problem.pointer,
        f"There is no channel '{pattern}' at point {min(lacking)}, where a joint is ideal; leave"
        " the channel out, or the point.",
    )


def _offers(scene: Scene, pattern: str) -> bool:
    try:
        return bool(select(channels(scene), [pattern], ""))
    except InvalidInput:
        return False
