"""Sections that suit a scene, to begin with: one of each form that its studies may have."""

from typing import Literal

from jointplay.solver.kinds.observables import coordinates_with_rates
from jointplay.solver.kinds.section import ChannelSection, CrankSection, OnsetSection
from jointplay.solver.laws.force.motor import Motor
from jointplay.solver.laws.force.torque import Torque
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import common_period

INDICES = {"x": 0, "y": 1, "theta": 2}
"""Index of a coordinate among those of its body."""


def proposed_sections(scene: Scene) -> list[CrankSection | OnsetSection | ChannelSection]:
    """Return sections that suit a scene, the most usual first.

    Once a period, if there is one; at onsets of the first joint that has play, if one has; and
    where the first coordinate crosses a value.
    """
    found: list[CrankSection | OnsetSection | ChannelSection] = []
    if common_period(scene).seconds is not None:
        found.append(CrankSection())
    if pairs := spanning_tree(scene).pairs:
        found.append(OnsetSection(onset=pairs[0]))
    return [*found, _crossing(scene)]


def _crossing(scene: Scene) -> ChannelSection:
    """Return a crossing that motion passes again and again.

    What starts with a speed, or is turned by a torque, comes back to where it started. From rest it
    may never come back quite so far, but turns back, where its rate is zero.
    """
    first = next(iter(scene.bodies))
    channel, rate = next(iter(coordinates_with_rates(scene)), (f"{first}.theta", f"{first}.omega"))
    body, _, kind = channel.partition(".")
    index = 3 * list(scene.bodies).index(body) + INDICES[kind]
    start = assemble(scene)
    turned = any(isinstance(element, Torque | Motor) for element in scene.forces.values())
    speed = float(start.velocity[index])
    if speed or (turned and kind == "theta"):
        direction: Literal["up", "down"] = "down" if speed < 0.0 else "up"
        value = float(f"{start.pose[index]:.6g}")
        return ChannelSection(channel=channel, value=value, direction=direction)
    return ChannelSection(channel=rate, value=0.0)
