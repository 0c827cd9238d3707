"""Facts that scenes of one structure share, found once: jobs differ mostly in their numbers."""

from collections.abc import Callable, Hashable
from functools import wraps
from typing import TypeVar

from jointplay.records.bounded_dict import BoundedDict
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.once_per_scene import once_per_scene
from jointplay.solver.scene.references import inner_states

MOST_KEPT = 256
"""Structures of which something is kept."""
Found = TypeVar("Found")


def per_structure(function: Callable[[Scene], Found]) -> Callable[[Scene], Found]:
    """Have a function look at one scene of each structure; what it returns is shared.

    It may depend on names, references, which joints have play or oil, and outputs; on no other
    number.
    """
    known: BoundedDict[Hashable, Found] = BoundedDict(MOST_KEPT)

    @wraps(function)
    def remembered(scene: Scene) -> Found:
        key = _structure(scene)
        found = known.get(key)
        if found is None:
            found = known[key] = function(scene)
        return found

    return remembered


@once_per_scene
def _structure(scene: Scene) -> Hashable:
    """Return what scenes of one structure have in common, to look things up by."""
    return (
        tuple(scene.bodies),
        tuple((name, j.type, j.ends, j.has_play, j.has_moment) for name, j in scene.joints.items()),
        tuple(
            (name, tuple(s.name for s in states)) for name, states in inner_states(scene).items()
        ),
        tuple((name, gear.first, gear.second) for name, gear in scene.gears.items()),
        tuple((name, driver.joint, driver.body) for name, driver in scene.drivers.items()),
        tuple((name, e.type, e.first, e.second) for name, e in scene.forces.items()),
        tuple(scene.recorded),
        tuple((o.name, o.channel, o.factor, o.offset, o.help) for o in scene.outputs),
    )
