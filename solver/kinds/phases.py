"""Sections of starts that differ in a driver's phase: where the driver stands alike."""

import re
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.scene.clocks import clocks, turns
from jointplay.solver.scene.drivers import SteadyDriver

_POSITION: Final = re.compile(r"/drivers/([^/]+)/position")


def phase_offsets(scenes: PointScenes, crank_angle: float) -> Floats | None:
    """Return (points,) s behind whole periods: when a driver whose position varies is at an angle.

    None where no driver's position varies, or another driver or a force changes in time, too: then
    points with other phases are other systems, which share no attractor.
    """
    varied = [found[1] for leaf in scenes.leaves if (found := _POSITION.fullmatch(leaf.path))]
    if not varied or varied != [name for name, one in clocks(scenes.base).items() if one.rate]:
        return None
    driver = scenes.base.drivers[varied[0]]
    if not isinstance(driver, SteadyDriver) or not turns(scenes.base, driver):
        return None
    speed, position = (
        scenes.numbers(f"/drivers/{varied[0]}/{field}") for field in ("speed", "position")
    )
    there = np.copysign(crank_angle, speed)
    return np.asarray((there - position) / speed % (2.0 * np.pi / np.abs(speed)), np.float64)
