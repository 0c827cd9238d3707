"""Sections of a study that would never be taken are refused before anything is queued."""

from __future__ import annotations

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.admission.crossings import crossing_problems
from jointplay.solver.admission.observables import shared_channels
from jointplay.solver.admission.points import Points
from jointplay.solver.admission.spans import Periods
from jointplay.solver.admission.varied import CheckedPoints
from jointplay.solver.jobs import ChannelSection, OnsetSection, SectionStudyJob


def check_section(
    job: SectionStudyJob, points: Points, checked: CheckedPoints, units: Periods, *, thorough: bool
) -> None:
    """Check that a job's section is taken at every point; crossings only if `thorough`.

    Raises
    ------
    InvalidInput
        With what would be right.
    """
    section = job.section
    if isinstance(section, OnsetSection):
        problems = _onset(section, checked)
    elif isinstance(section, ChannelSection):
        problems = _crossing(section, points, checked) if thorough else []
    else:
        problems = _turns(points, checked, units)
    if problems:
        raise InvalidInput(problems)


def _turns(points: Points, checked: CheckedPoints, units: Periods) -> list[Problem]:
    """Sections at a crank angle need a period at every point."""
    return [
        Problem(
            points.place(point) if points.axes else "/section",
            (points.name(point, checked.declared) if points.axes else "")
            + note
            + " A section at onsets of contact or at a channel's crossing needs none.",
        )
        for point, note in units.notes.items()
    ]


def _crossing(section: ChannelSection, points: Points, checked: CheckedPoints) -> list[Problem]:
    shared = shared_channels(checked)
    found = next((channel for channel in shared if channel.name == section.channel), None)
    if found is None:
        sentence = unknown("channel", section.channel, [channel.name for channel in shared])
        return [Problem("/section/channel", sentence)]
    return list(crossing_problems(section, found, points, checked))


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
