"""The joints with play that are shown magnified, and what they are drawn from."""

from collections.abc import Mapping
from typing import Any, Final

from jointplay.figures import scene_facts
from jointplay.figures.animation.follower import Follower
from jointplay.figures.animation.journal import Journal
from jointplay.figures.animation.walls import BetweenWalls
from jointplay.figures.kind import Selection, at_most
from jointplay.records.arrays import Floats
from jointplay.records.channel import by_name
from jointplay.records.joint_marks import marks_of
from jointplay.records.run import Source

Inset = Journal | BetweenWalls | Follower
PICTURES: Final[dict[str, type[Journal] | type[BetweenWalls] | type[Follower]]] = {
    "journal": Journal,
    "walls": BetweenWalls,
    "surface": Follower,
}
"""Pictures by the name that marks of joints give them."""
MOST: Final = 6
"""Joints of one film."""


def magnified(source: Source, selection: Selection) -> dict[str, tuple[str, ...]]:
    """Name the joints that are shown magnified, each with its channels.

    Those that were chosen; else the first joints with play whose channels were stored.

    Raises
    ------
    NotDrawable
        A chosen joint has no play, or its channels were not stored, or there are too many.
    """
    scene = scene_facts.scene(source)
    joints = scene.get("joints", {})
    found = {
        name: PICTURES[marks_of(joints[name])["picture"]].channels(name, joints[name])
        for name in scene_facts.clearances(scene)
        if marks_of(joints[name])["picture"] and scene_facts.is_drawn(scene, name)
    }
    if selection.joints:
        scene_facts.check_joints(found, selection)
        chosen = at_most(MOST, selection.joints, "joints")
        return {name: scene_facts.stored(source, found[name]) for name in chosen}
    known = by_name(source.channels)
    whole = [name for name, channels in found.items() if all(one in known for one in channels)]
    return {name: found[name] for name in whole[:MOST]}


def insets(
    scene: Mapping[str, Any], names: list[str], columns: Mapping[str, Floats]
) -> dict[str, Inset]:
    """Make the pictures of a scene's joints, by name, from (m,) values by channel."""
    pictures = {name: marks_of(scene["joints"][name])["picture"] for name in names}
    return {name: PICTURES[picture](name, scene, columns) for name, picture in pictures.items()}
