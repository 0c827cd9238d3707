"""Facts of a study that figures need: observables in pairs, directions, verdicts."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jointplay.figures import colours
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.records.arrays import Flags
from jointplay.records.channel import Channel, by_name
from jointplay.records.channel_choice import no_such_channel
from jointplay.records.study import BACKWARD, FORWARD, StudySource, directions_of

_RATES = {
    "eccentricity_x": "eccentricity_rate_x",
    "eccentricity_y": "eccentricity_rate_y",
    "x": "vx",
    "y": "vy",
    "theta": "omega",
}
COLOURS = {
    "periodic": colours.PERIODIC,
    "quasi-periodic": colours.QUASI_PERIODIC,
    "chaotic": colours.CHAOTIC,
    "equilibrium": colours.EQUILIBRIUM,
    "undecided": colours.UNDECIDED,
}
"""By verdict, in the order of legends."""
UNJUDGED = colours.NO_VERDICT


@dataclass(frozen=True)
class Group:
    """Points that are drawn alike: name for the legend, colour, and (points,) which they are."""

    name: str
    colour: str
    members: Flags


def observed_pairs(source: StudySource) -> list[tuple[str, str]]:
    """Give (position, rate) for every observable whose rate was observed too.

    Those of joints come first: where joints have play, that is what a study looks at.
    """
    names = by_name(source.observables)
    found = []
    for name in names:
        part, _, quantity = name.rpartition(".")
        rate = f"{part}.{_RATES.get(quantity)}"
        if rate in names:
            found.append((name, rate))
    return sorted(found, key=lambda pair: ".eccentricity_" not in pair[0])


def fixed(source: StudySource) -> str:
    """Return the channel that the study's section holds at a value; empty: none."""
    section = source.attributes["job"].get("section") or {}
    return str(section.get("channel", ""))


def moving_pairs(source: StudySource) -> list[tuple[str, str]]:
    """Give `observed_pairs` without those that the section holds, unless nothing else is left."""
    pairs, held = observed_pairs(source), fixed(source)
    return [pair for pair in pairs if held not in pair] or pairs


def statistics(source: StudySource) -> tuple[Channel, ...]:
    """Give the statistics of channels and joints whose meaning the study gives."""
    meanings = source.attributes.get("meanings", {})
    return tuple(Channel(name, *meanings[name]) for name in source.statistics if name in meanings)


def known(names: tuple[str, ...], channels: Sequence[Channel]) -> tuple[str, ...]:
    """Return the names that were asked for if all of them are channels of the study.

    Raises
    ------
    NotDrawable
        One is none; the sentence names near ones.
    """
    offered = list(by_name(channels))
    if unknown := [name for name in names if name not in offered]:
        raise NotDrawable(str(no_such_channel(unknown, offered)), "channels")
    return names


def chosen_points(source: StudySource, selection: Selection) -> slice:
    """Give the points to draw.

    Raises
    ------
    NotDrawable
        There are none in this range.
    """
    for name, value in (("start", selection.start), ("stop", selection.stop)):
        if value is not None and (value < 0 or not float(value).is_integer()):
            raise NotDrawable(f"{name} is {value:g}; points of a study are counted from 0.", name)
    first = int(selection.start or 0)
    end = source.points if selection.stop is None else int(selection.stop)
    if not first < end <= source.points:
        raise NotDrawable(
            f"The study has points 0 to {source.points - 1}; choose a range of them, not from"
            f" {first} to before {end}.",
            "start" if selection.start is not None and first >= source.points else "stop",
        )
    return slice(first, end)


def everything(source: StudySource) -> Group:
    """Give all points alike."""
    return Group("sections", colours.COMPUTED, np.ones(source.points, dtype=bool))


def directions(source: StudySource) -> tuple[Group, ...]:
    """Give forward and backward points of a continuation in both directions, else nothing."""
    found = directions_of(source)
    if found is None:
        return ()
    told = {FORWARD: colours.FORWARD, BACKWARD: colours.BACKWARD}
    return tuple(Group(name, colour, found == name) for name, colour in told.items())


def by_verdict(source: StudySource) -> tuple[Group, ...]:
    """Give the points of every verdict that occurs, and those without one; nothing if none has."""
    codes = source.verdicts
    if codes is None or not (codes >= 0).any():
        return ()
    names = list(source.verdict_names)
    groups = [
        Group(name, COLOURS.get(name, UNJUDGED), codes == names.index(name))
        for name in dict.fromkeys((*COLOURS, *names))
        if name in names
    ]
    groups.append(Group("no verdict", UNJUDGED, (codes < 0) & (source.counts > 0)))
    return tuple(group for group in groups if group.members.any())
