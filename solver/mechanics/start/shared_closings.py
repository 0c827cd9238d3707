"""Closed poses of starts that differ in where journals begin: found once, of centred ones.

To look for all ways in which a mechanism closes takes tenths of a second, and the points of a study
of starts differ in each of them by no more than their play.
"""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.bounded_dict import BoundedDict
from jointplay.solver.mechanics.closing import close
from jointplay.solver.mechanics.start.closings import closings
from jointplay.solver.mechanics.start.demands import Demands
from jointplay.solver.scene.document import Scene, Start

SMALL = 1e-2
"""Distance from the middle of its play, in lengths of the shortest link, or rad, up to which a
start is beside the centred one …"""
BESIDE = 0.1
"""… and up to which a pose is."""
MOST_KEPT = 64
MECHANISM: Final[Any] = {
    "ground": True,
    "bodies": {"__all__": {"points"}},
    "joints": True,
    "gears": True,
    "drivers": True,
}
"""Parts of a scene on which it depends how a mechanism closes, but for its start."""
_kept: BoundedDict[str, list[Floats]] = BoundedDict(MOST_KEPT)


def shared_closings(demands: Demands) -> Iterator[Floats]:
    """Yield closed poses, each once, as `closings` does.

    Near a dead point that a start passes, what closes with centred journals may not do so with
    others: then they are looked for.
    """
    found = _beside_centred(demands)
    yield from closings(demands) if found is None else found


def _beside_centred(demands: Demands) -> list[Floats] | None:
    """Return the poses beside those of centred journals; None: there may be others."""
    start = demands.scene.start
    if not (start.joints or start.guides) or _largest(start, demands.length) > SMALL:
        return None
    found = []
    for centred in _centred(demands.scene, demands.length):
        pose = centred.copy()
        close(demands.closed, pose, demands.driven, demands.scale)
        if np.abs((pose - centred) / demands.scale).max() > BESIDE:
            return None
        if not demands.is_closed(demands.closed, pose):
            return None
        found.append(pose)
    return found or None


def _centred(scene: Scene, length: float) -> list[Floats]:
    """Return the closed poses of a scene whose joints with play are centred."""
    key = scene.model_dump_json(include=MECHANISM, exclude={"joints": {"__all__": {"clearance"}}})
    key += "".join(str(int(joint.has_play)) for joint in scene.joints.values())
    found = _kept.get(key)
    if found is None:
        centred = scene.model_copy(update={"start": Start()})
        found = _kept[key] = list(closings(Demands.of(centred, length)))
    return found


def _largest(start: Start, length: float) -> float:
    """Return how far the farthest joint is from the middle of its play; see `SMALL`."""
    journals = [abs(part) / length for one in start.joints.values() for part in one.eccentricity]
    guides = [max(abs(one.offset) / length, abs(one.tilt)) for one in start.guides.values()]
    return max([*journals, *guides], default=0.0)
