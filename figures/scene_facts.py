"""Facts of a scene that figures need: declared outputs and clearance joints.

Names come from the scene document alone; no mechanism is known here.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from jointplay.figures.kind import NotDrawable, Selection
from jointplay.records.channel import Channel, by_name
from jointplay.records.joint_marks import marks_of, play_of
from jointplay.records.run import Source


def outputs(source: Source) -> tuple[str, ...]:
    """Name the declared outputs that were stored, in the order of the scene."""
    known = by_name(source.channels)
    declared = [output["name"] for output in scene(source).get("outputs", ())]
    return tuple(name for name in declared if name in known)


def clearances(scene_document: Mapping[str, Any]) -> dict[str, float]:
    """Give the clearance [m] of every joint that has one above zero: radial, to a wall, lash."""
    found: dict[str, float] = {}
    for name, joint in scene_document.get("joints", {}).items():
        play = play_of(joint)
        if play > 0.0:
            found[name] = play
    return found


def is_drawn(scene_document: Mapping[str, Any], name: str) -> bool:
    """Tell whether the curves of a joint are there, if it has any: older results lack them."""
    has_curves = marks_of(scene_document["joints"][name])["has_curves"]
    return not has_curves or any(one["joint"] == name for one in scene_document["curves"])


def chosen_joints(source: Source, selection: Selection) -> dict[str, float]:
    """Give the journals with clearance to draw with their radial clearance [m].

    Raises
    ------
    NotDrawable
        There is none, or one was asked for that has no clearance.
    """
    joints = scene(source).get("joints", {})
    found = clearances(scene(source))
    known = {name: play for name, play in found.items() if marks_of(joints[name])["is_journal"]}
    check_joints(known, selection, "revolute joint")
    return {name: known[name] for name in selection.joints or known}


def chosen_pairs(source: Source, selection: Selection) -> list[str]:
    """Name the contact pairs to draw: those of the clearance joints that were chosen.

    Raises
    ------
    NotDrawable
        There is none, or one was asked for that has no clearance.
    """
    parts = (pair.partition(".")[0] for pair in source.joints)
    check_joints(list(dict.fromkeys([*parts, *source.joints])), selection)
    chosen = selection.joints or source.joints
    return [pair for name in chosen for pair in source.joints if f"{pair}.".startswith(f"{name}.")]


def check_joints(known: Collection[str], selection: Selection, kind: str = "joint") -> None:
    """Refuse chosen joints that are not among the known ones with clearance, or if there is none.

    `kind` says in words which joints the figure can show.

    Raises
    ------
    NotDrawable
        As that says.
    """
    if not known:
        raise NotDrawable(f"This figure needs a {kind} with clearance, and the scene has none.")
    for name in selection.joints:
        if name not in known:
            raise NotDrawable(
                f"No {kind} {name!r} has clearance; those that do are {', '.join(known)}.", "joints"
            )


def stored(source: Source, names: Sequence[str]) -> tuple[str, ...]:
    """Return the names if all of them were stored.

    Raises
    ------
    NotDrawable
        Some were not; the sentence names them.
    """
    known = by_name(source.channels)
    if missing := [name for name in names if name not in known]:
        raise NotDrawable(
            f"The results do not hold {', '.join(missing)}, which this figure is drawn from; "
            "choose these channels when the job is submitted."
        )
    return tuple(names)


def channel(source: Source, name: str) -> Channel:
    """Give unit and meaning of a stored channel."""
    return by_name(source.channels)[name]


def scene(source: Source) -> Mapping[str, Any]:
    """Give the scene document, with the `curves` of its joints; empty if there is no document."""
    found: dict[str, Any] = source.attributes.get("scene") or {}
    return found and found | {"curves": source.attributes.get("curves", [])}
