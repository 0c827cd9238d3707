"""Sections of a study that would never be taken are refused before anything is queued."""

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.kinds.checked_points import CheckedPoints
from jointplay.solver.kinds.crossings import crossing_problems
from jointplay.solver.kinds.observables import shared_channels
from jointplay.solver.kinds.periods import Periods
from jointplay.solver.kinds.section import (
    ChannelSection,
    CrankSection,
    OnsetSection,
)


def check_section(
    section: CrankSection | OnsetSection | ChannelSection, checked: CheckedPoints, units: Periods
) -> None:
    """Check that a section is taken at every point.

    Raises
    ------
    InvalidInput
        With what would be right.
    """
    if isinstance(section, OnsetSection):
        problems = _onset(section, checked)
    elif isinstance(section, ChannelSection):
        problems = _crossing(section, checked)
    else:
        problems = _turns(checked, units)
    if problems:
        raise InvalidInput(problems)


def _turns(checked: CheckedPoints, units: Periods) -> list[Problem]:
    """Sections at a crank angle need a period at every point."""
    points = checked.points
    return [
        Problem(
            points.place(point) if points.axes else "/section",
            checked.beginning(point)
            + note
            + " A section at onsets of contact or at a channel's crossing needs none.",
        )
        for point, note in units.notes.items()
    ]


def _crossing(section: ChannelSection, checked: CheckedPoints) -> list[Problem]:
    shared = shared_channels(checked)
    found = next((channel for channel in shared if channel.name == section.channel), None)
    if found is None:
        sentence = unknown("channel", section.channel, [channel.name for channel in shared])
        return [Problem("/section/channel", sentence)]
    return list(crossing_problems(section, found, checked))


def _onset(section: OnsetSection, checked: CheckedPoints) -> list[Problem]:
    joints = checked.declared.joints
    if section.onset not in joints:
        return [Problem("/section/onset", unknown("joint", section.onset, joints))]
    for mechanism in checked.mechanisms:
        play = mechanism.tree.play
        if section.onset not in play:
            there = f"; joints with clearance are: {', '.join(play)}." if play else "."
            return [
                Problem(
                    "/section/onset",
                    f"Joint '{section.onset}' has no clearance at point {mechanism.point}, so no"
                    f" contact begins there{there}",
                )
            ]
    return []
