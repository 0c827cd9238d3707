"""Mean and spread of a point's states over its last cycles of sections.

Both are the same wherever on a cycle the record ends, so that points on one attractor have the same
numbers, to what is left of their transients.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.attractors import MEAN, SPREAD
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.document import Scene
from jointplay.solver.statistics import Output

_UNITS = {"theta": ("rad", "rad/s"), "s": ("m", "m/s"), "x": ("m", "m/s"), "y": ("m", "m/s")}


def names_of(coordinates: Sequence[str]) -> list[str]:
    """Return the names of coordinates and speeds, in the order of states."""
    return [*coordinates, *(f"{name}_rate" for name in coordinates)]


def outputs_of(scene: Scene) -> dict[str, Output]:
    """Return unit and long name of the numbers that a point has."""
    coordinates = spanning_tree(scene).coordinates
    units = [_UNITS[name.split(".")[1]][rate] for rate in (0, 1) for name in coordinates]
    return {
        f"{kind}{name}": (unit, f"{what} over a cycle of {name}")
        for kind, what in ((MEAN, "mean"), (SPREAD, "spread"))
        for name, unit in zip(names_of(coordinates), units, strict=True)
    }


def attributes_of(scene: Scene, period: float) -> dict[str, Any]:
    """Return facts by which cycles are compared: what counts as one in each state, the angles."""
    coordinates = spanning_tree(scene).coordinates
    scales = start_scales(scene, coordinates, period)
    names = names_of(coordinates)
    return {
        "scales": dict(zip(names, scales.tolist(), strict=False)),
        "angles": [name for name in coordinates if name.endswith(".theta")],
    }


def cycle_of(
    coordinates: Sequence[str], sections: Floats, angles: Flags, period: int
) -> dict[str, float]:
    """Return mean and spread of the states over the last whole cycles of a record.

    Parameters
    ----------
    coordinates
        Names of the generalised coordinates.
    sections
        (sections, states) coordinates, then their speeds, then inner states, which are left out.
        Angles are without the whole turns made since the first section.
    angles
        (states,) which are angles: their means are within half a turn of zero.
    period
        Sections of a cycle; 0: the record is all there is of one.

    Without sections nothing is known: NaN.
    """
    count = 2 * len(coordinates)
    if not len(sections):
        sections = np.full((1, count), math.nan)
    cycle = period or len(sections)
    whole = sections[len(sections) % cycle :, :count]
    mean, spread = whole.mean(axis=0), whole.std(axis=0)
    turns = np.round(mean / (2.0 * math.pi)) * angles[:count]
    mean = mean - 2.0 * math.pi * turns
    found: dict[str, float] = {}
    for name, centre, width in zip(names_of(coordinates), mean, spread, strict=True):
        found |= {f"{MEAN}{name}": float(centre), f"{SPREAD}{name}": float(width)}
    return found
