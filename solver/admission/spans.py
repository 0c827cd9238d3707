"""How long each point of a study runs, and in which unit of time."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.admission.varied import CheckedPoints
from solver.assembly import shortest_link
from solver.drive import characteristic_time, common_period
from solver.scene.document import Revolute, Scene

Floats = NDArray[np.float64]
_SPEED = re.compile(r"/drivers/[^/]+/speed")


@dataclass(frozen=True, eq=False)
class Periods:
    """The time units of all points.

    Attributes
    ----------
    seconds : (points,) float
        The least common period of the drivers, s; where there is none, the scene's time scale.
    common : (points,) bool
        Whether it is a common period.
    notes : dict
        By point without one, first of its kind: why there is none.
    first_speed : (points,) float
        Of the first driver that turns, rad/s, positive; 1 where none does.
    """

    seconds: Floats
    common: NDArray[np.bool_]
    notes: dict[int, str]
    first_speed: Floats


def periods(checked: CheckedPoints) -> Periods:
    """Return the time units of all points."""
    scenes = checked.scenes
    count = len(scenes.values)
    changing = any(_SPEED.fullmatch(leaf.path) for leaf in scenes.leaves)
    seconds, speed = np.empty(count), np.empty(count)
    common = np.empty(count, np.bool_)
    notes: dict[int, str] = {}
    for point in range(count if changing else 1):
        scene = scenes.scene(point)
        period = common_period(scene)
        common[point] = period.seconds is not None
        if period.seconds is None and period.note not in notes.values():
            notes[point] = period.note
        seconds[point] = period.seconds or characteristic_time(scene, shortest_link(scene))
        speed[point] = first_speed(scene)
    if not changing:
        seconds[:], common[:], speed[:] = seconds[0], common[0], speed[0]
        if not common[0]:  # gravity and lengths set the time scale
            for point in range(1, count):
                scene = scenes.scene(point)
                seconds[point] = characteristic_time(scene, shortest_link(scene))
    return Periods(seconds, common, notes, speed)


def first_speed(scene: Scene) -> float:
    """Return the speed of the first driver that turns, rad/s, positive; 1 if none does."""
    turning = (
        abs(driver.speed)
        for driver in scene.drivers.values()
        if driver.speed != 0.0 and isinstance(scene.joints[driver.joint], Revolute)
    )
    return next(turning, 1.0)


def crank_offsets(found: Periods, crank_angle: float) -> Floats:
    """Return (points,) s: when the first driver has turned that far; see `section_offset`."""
    if not crank_angle:
        return np.zeros(len(found.seconds))
    return np.minimum(crank_angle / found.first_speed, found.seconds)
