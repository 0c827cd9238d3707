"""Channels of a study: what every point offers, what is kept unless the job says otherwise."""

import math
from collections.abc import Iterator, Sequence

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.checked_points import CheckedPoints, Mechanism
from jointplay.solver.mechanics.tree import Branch
from jointplay.solver.scene.channels import select
from jointplay.solver.scene.document import Prismatic

RATES = {"x": "vx", "y": "vy", "theta": "omega"}
ECCENTRICITY = (
    "eccentricity_x",
    "eccentricity_y",
    "eccentricity_rate_x",
    "eccentricity_rate_y",
)
LOADS = ("normal_force", "penetration")


def shared_channels(checked: CheckedPoints) -> tuple[Channel, ...]:
    """Return the channels that every point offers: an ideal joint has no eccentricity."""
    others = [{c.name for c in mechanism.channels} for mechanism in checked.mechanisms[1:]]
    return tuple(
        channel
        for channel in checked.mechanisms[0].channels
        if all(channel.name in names for names in others)
    )


def chosen(
    checked: CheckedPoints, patterns: Sequence[str] | None, default: Sequence[str], pointer: str
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


def coordinate_channels(checked: CheckedPoints) -> list[str]:
    """Return the generalised coordinates and eccentricities with their rates.

    Where points differ in their coordinates, those of the structure with most of them.
    """
    mechanism = max(checked.mechanisms, key=lambda found: len(found.tree.coordinates))
    names = []
    for branch in mechanism.tree.branches:
        for coordinate in branch.coordinates:
            body, kind = coordinate.split(".")
            kind = _direction(mechanism, branch) if kind == "s" else kind
            names += [f"{body}.{kind}", f"{body}.{RATES[kind]}"]
    return names + [f"{joint}.{name}" for joint in mechanism.tree.play for name in ECCENTRICITY]


def peak_channels(checked: CheckedPoints) -> list[str]:
    """Return the declared outputs, and the loads of each joint with clearance."""
    return [output.name for output in checked.declared.outputs] + [
        f"{joint}.{name}"
        for mechanism in checked.mechanisms
        for joint in mechanism.tree.play
        for name in LOADS
    ]


def _direction(mechanism: Mechanism, branch: Branch) -> str:
    """Return the axis of the world to which a guide is closer as it stands at t = 0."""
    joint = mechanism.scene.joints[branch.joint]
    if not isinstance(joint, Prismatic):
        return "x"
    guide = joint.guide.split(".")[0]
    bodies = list(mechanism.scene.bodies)
    turned = 0.0 if guide == "ground" else mechanism.assembly.pose[3 * bodies.index(guide) + 2]
    angle = math.atan2(joint.axis[1], joint.axis[0]) + float(turned)
    return "x" if abs(math.cos(angle)) >= abs(math.sin(angle)) * (1.0 - 1e-12) else "y"


def _explained(
    checked: CheckedPoints, problem: Problem, patterns: Sequence[str], pointer: str
) -> Problem:
    """Say of a channel that only some points offer which points lack it."""
    pattern = patterns[int(problem.pointer.removeprefix(f"{pointer}/"))]
    offering = set(_offering(checked, pattern))
    lacking = [m.point for k, m in enumerate(checked.mechanisms) if k not in offering]
    if not offering:
        return problem
    return Problem(
        problem.pointer,
        f"There is no channel '{pattern}' at point {min(lacking)}, where a joint is ideal; leave"
        " the channel out, or the point.",
    )


def _offering(checked: CheckedPoints, pattern: str) -> Iterator[int]:
    for index, mechanism in enumerate(checked.mechanisms):
        try:
            select(mechanism.channels, [pattern], "")
        except InvalidInput:
            continue
        yield index
