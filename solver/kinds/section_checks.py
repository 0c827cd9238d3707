"""Sections of a study that would never be taken are refused before anything is queued."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.kinds.observables import shared_channels
from jointplay.solver.kinds.periods import Periods
from jointplay.solver.kinds.section import ChannelSection, CrankSection, OnsetSection
from jointplay.solver.kinds.studies import PlacedPoints
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.ideal.reach import motion_reach
from jointplay.solver.scene.channels import BODY
from jointplay.solver.scene.pairs import pairs_of


def check_section(
    section: CrankSection | OnsetSection | ChannelSection, checked: PlacedPoints, units: Periods
) -> None:
    """Refuse (InvalidInput) a section that is not taken at every point; say what would be right."""
    if isinstance(section, OnsetSection):
        problems = _onset(section, checked)
    elif isinstance(section, ChannelSection):
        problems = _crossing(section, checked)
    else:
        problems = _turns(checked, units)
    if problems:
        raise InvalidInput(problems)


def _turns(checked: PlacedPoints, units: Periods) -> list[Problem]:
    """Sections at a crank angle need a period at every point."""
    points = checked.points
    return [
        Problem(
            points.pointer(point) if points.axes else "/section",
            checked.beginning(point)
            + note
            + " The scene may give a 'period' (s) of its own. A section at onsets of contact or at"
            " a channel's crossing needs none.",
        )
        for point, note in units.notes.items()
    ]


def _crossing(section: ChannelSection, checked: PlacedPoints) -> list[Problem]:
    shared = shared_channels(checked)
    found = next((channel for channel in shared if channel.name == section.channel), None)
    if found is None:
        sentence = unknown("channel", section.channel, [channel.name for channel in shared])
        return [Problem("/section/channel", sentence)]
    return list(crossing_problems(section, found, checked))


def _onset(section: OnsetSection, checked: PlacedPoints) -> list[Problem]:
    joints = checked.declared.joints
    pairs = {pair.name for name, joint in joints.items() for pair in pairs_of(name, joint)}
    if section.onset not in pairs | set(joints):
        return [Problem("/section/onset", unknown("joint", section.onset, joints))]
    for point, scene in checked.first_scenes.items():
        here = spanning_tree(scene).pairs
        if section.onset in here:
            continue
        own = [pair for pair in here if pair.startswith(f"{section.onset}.")]
        if own:
            sentence = (
                f"Joint '{section.onset}' has several contacts; take one of {', '.join(own)}."
            )
        else:
            there = f"; contacts begin in: {', '.join(here)}." if here else "."
            sentence = (
                f"Joint '{section.onset}' has no clearance at point {point}, so no contact begins"
                f" there{there}"
            )
        return [Problem("/section/onset", sentence)]
    return []


POINTER = "/section/value"
LARGEST_ANGLE = 1e6
"""Angle of a section, rad: turns are told apart to 1e-10 rad there, and not at all far beyond."""


def crossing_problems(
    section: ChannelSection, channel: Channel, checked: PlacedPoints
) -> Iterator[Problem]:
    """Yield why a channel does not cross a section's value, if that can be known beforehand."""
    output = next((o for o in checked.declared.outputs if o.name == channel.name), None)
    seen = _Seen(channel, section.value)
    if output is not None:
        seen = _Seen(channel, section.value, output.channel, output.factor, output.offset)
    if channel.unit == "rad" and abs(section.value) > LARGEST_ANGLE:
        sentence = (
            f"An angle is crossed once a turn, whatever turns its value has; give one between"
            f" -{LARGEST_ANGLE:g} and {LARGEST_ANGLE:g} rad, such as"
            f" {math.remainder(section.value, 2.0 * math.pi):.6g}."
        )
        yield Problem(POINTER, sentence)
        return
    part, _, quantity = seen.source.rpartition(".")
    joint = part.partition(".")[0]
    if part in checked.declared.bodies and quantity in {name for name, _, _ in BODY}:
        yield from _motion(seen, part, quantity, checked)
    elif joint in checked.declared.joints:
        yield from _play(seen, joint, quantity, checked)
    elif seen.source == "energy.kinetic" and seen.at_source <= 0.0:
        yield Problem(POINTER, "The kinetic energy is never below zero; give a value above.")


@dataclass(frozen=True)
class _Seen:
    """A section's channel, and the channel that it is a multiple of: factor * source + offset."""

    channel: Channel
    value: float
    own_source: str = ""
    factor: float = 1.0
    offset: float = 0.0

    @property
    def source(self) -> str:
        return self.own_source or self.channel.name

    @property
    def at_source(self) -> float:
        """The section's value as the source has it."""
        return (self.value - self.offset) / self.factor

    def refused(self, low: float, high: float) -> str:
        """Return the sentence about a value outside the bounds of the source."""
        ends = sorted((self.factor * low + self.offset, self.factor * high + self.offset))
        unit = "" if self.channel.unit == "1" else f" {self.channel.unit}"
        return (
            f"'{self.channel.name}' never crosses {self.value:g}{unit}: it stays between"
            f" {ends[0]:.6g} and {ends[1]:.6g}{unit}."
        )


def _motion(seen: _Seen, body: str, quantity: str, checked: PlacedPoints) -> Iterator[Problem]:
    """Yield what the ideal mechanism and its play rule out, at the first point where they do."""
    for point in _sample(checked):
        found = motion_reach(checked.scenes.scene(point))
        reach = None if found is None else found.of(body, quantity)
        if reach is None:
            continue
        name = seen.channel.name
        pointer, sentence = "/section/channel", ""
        if reach.turns:
            continue
        if reach.low == reach.high:
            sentence = f"'{name}' does not change in this mechanism; take another channel."
        elif not reach.low <= _nearest(seen, quantity, reach.low) <= reach.high:
            pointer, sentence = POINTER, seen.refused(reach.low, reach.high)
        if sentence:
            yield Problem(pointer, checked.beginning(point) + sentence)
            return


def _nearest(seen: _Seen, quantity: str, low: float) -> float:
    """Return the section's value at the source; an angle's, whole turns on, not below `low`."""
    if quantity != "theta":
        return seen.at_source
    turn = 2.0 * math.pi
    return seen.at_source + turn * math.ceil((low - seen.at_source) / turn)


def _play(seen: _Seen, joint: str, quantity: str, checked: PlacedPoints) -> Iterator[Problem]:
    """Yield what a joint's clearance rules out, at the first point where it does.

    However soft a contact is, the centre of a journal is within its bearing, as at a start.
    """
    value = seen.at_source
    if quantity == "normal_force" and value <= 0.0 and checked.declared.joints[joint].has_play:
        yield Problem(POINTER, "A normal force is never below zero; give a value above.")
    if quantity not in ("eccentricity_x", "eccentricity_y", "penetration"):
        return
    slack = checked.declared.joints[joint].slack
    if slack is None or not checked.declared.joints[joint].is_journal:
        return
    clearance = checked.scenes.numbers(f"/joints/{joint}/clearance/{slack.play_field}")
    bearing = checked.scenes.numbers(f"/joints/{joint}/clearance/bearing_radius")
    low, high = (
        (-clearance, bearing - clearance) if quantity == "penetration" else (-bearing, bearing)
    )
    beyond = np.flatnonzero(~((low < value) & (value < high)))
    if len(beyond):
        point = int(beyond[0])
        sentence = (
            f"With a radial clearance of {clearance[point]:.6g} m in a bearing of radius"
            f" {bearing[point]:.6g} m "
        ) + seen.refused(float(low[point]), float(high[point]))
        yield Problem(POINTER, checked.beginning(point) + sentence)


def _sample(checked: PlacedPoints) -> list[int]:
    """Return some points at which to follow the ideal mechanism: it takes a tenth of a second.

    None where it moves freely, for then everything is in reach.
    """
    if any(assemble(scene).freedom for scene in checked.first_scenes.values()):
        return []
    chosen = list(checked.first_scenes)
    if checked.scenes.leaves:
        chosen.append(checked.points.count - 1)
    return sorted(set(chosen))[:4]
