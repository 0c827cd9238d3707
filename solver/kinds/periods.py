"""The unit of time of each point of a study: the period of its drivers."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.failure import InvalidInput
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.runs.study.fields import distinct, geometry_columns
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import common_period, first_speed, idle_period
from jointplay.solver.scene.time_scales import characteristic_time

_SPEED = re.compile(
    r"/period|/drivers/[^/]+/(speed|motion/.+)|/forces/[^/]+/(course/.+|no_load_speed)"
)
_GRAVITY = re.compile(r"/gravity/\d")


@dataclass(frozen=True, eq=False)
class Periods:
    """The time units of all points."""

    seconds: Floats
    """(points,) s: the least common period of the drivers, else the scene's own time scale."""
    notes: dict[int, str]
    """By point without a period, first of its kind: why there is none."""
    first_speed: Floats
    """(points,) rad/s, positive: of the first driver that has a period; 1 where none does."""


def periods(scenes: PointScenes) -> Periods:
    """Return the time units of all points."""
    count = len(scenes.values)
    driven = _driven(scenes)
    group = distinct(driven, count)
    seconds, speed = np.empty(count), np.empty(count)
    notes: dict[int, str] = {}
    lacking = np.zeros(count, np.bool_)
    firsts = np.unique(group, return_index=True)[1].tolist()
    alike = _members(group)
    for index, point in enumerate(firsts):
        scene = scenes.scene(point)
        period = common_period(scene)
        speed[alike[index]] = first_speed(scene)
        seconds[alike[index]] = period.seconds or 0.0
        if period.seconds is None:
            lacking[alike[index]] = True
            if period.note not in notes.values():
                notes[point] = period.note
    if notes:
        weights = [scenes.column(leaf) for leaf in scenes.leaves if _GRAVITY.fullmatch(leaf.path)]
        group = distinct([*driven, *weights, *geometry_columns(scenes)], count)
        for same in _members(group):
            if lacking[same[0]]:
                scene = scenes.scene(int(same[0]))
                seconds[same] = characteristic_time(scene, shortest_link(scene))
    return Periods(seconds, notes, speed)


def check_period(written: Scene, scenes: Iterable[Scene]) -> None:
    """Refuse (InvalidInput) a period that is not that of the scene as written, nor of any other."""
    if (idle := idle_period(written)) and all(map(idle_period, scenes)):
        raise InvalidInput.at("/scene/period", idle)


def differently_driven(scenes: PointScenes) -> Iterable[Scene]:
    """Return the scene of a first point of each period that points may have."""
    firsts = np.unique(distinct(_driven(scenes), len(scenes.values)), return_index=True)[1]
    return map(scenes.scene, firsts.tolist())


def _driven(scenes: PointScenes) -> list[Floats]:
    """Return the numbers on which periods depend, each (points,)."""
    return [scenes.column(leaf) for leaf in scenes.leaves if _SPEED.fullmatch(leaf.path)]


def _members(group: Integers) -> list[Integers]:
    """Return the points of each group, in order."""
    order = np.argsort(group, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(group[order])) + 1)


def crank_offsets(found: Periods, crank_angle: float) -> Floats:
    """Return (points,) s: when the first driver has turned that far; see `section_offset`."""
    if not crank_angle:
        return np.zeros(len(found.seconds))
    return np.minimum(crank_angle / found.first_speed, found.seconds)
