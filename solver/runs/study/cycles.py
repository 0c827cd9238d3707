"""Means, spreads and covariances of a point's states over its last cycles of sections.

They are the same wherever on a cycle the record ends, so that points on one attractor have the same
numbers, to what is left of their transients.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.cycles import COVARIANCE, INDEPENDENT, MEAN, SAME, SPREAD
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.quantities.scalars import direction_angle, sine_cosine
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
    found = {
        f"{kind}{name}": (unit, f"{what} over a cycle of {name}")
        for kind, what in ((MEAN, "mean"), (SPREAD, "spread"))
        for name, unit in zip(names_of(coordinates), units, strict=True)
    }
    found |= {
        f"{COVARIANCE}{name}": (unit, f"covariance over a cycle of {name} with states before it")
        for name, unit in zip(names_of(coordinates)[1:], units[1:], strict=True)
    }
    return {**found, INDEPENDENT: ("1", "independent sections of a motion that does not recur")}


def attributes_of(scene: Scene, period: float) -> dict[str, Any]:
    """Return facts by which cycles are compared: what counts as one in each state, the angles."""
    coordinates = spanning_tree(scene).coordinates
    scales = start_scales(scene, coordinates, period, scene.length)
    names = names_of(coordinates)
    return {
        "scales": dict(zip(names, scales.tolist(), strict=False)),
        "angles": [name for name in coordinates if name.endswith(".theta")],
    }


def cycle_of(
    coordinates: Sequence[str], sections: Floats, scales: Floats, angles: Flags, period: int
) -> dict[str, float]:
    """Return means, spreads and covariances of states over the last whole cycles of a record.

    Parameters
    ----------
    coordinates
        Names of the generalised coordinates.
    sections
        (sections, states) coordinates, then their speeds, then inner states, which are left out.
        Angles are without the whole turns made since the first section.
    scales
        (states,) what counts as one in each. What moves by less than attractors are told apart by
        says nothing of how sections depend on those before: it may be rounding that grows.
    angles
        (states,) which are angles: their means are within half a turn of zero.
    period
        Sections of a cycle; 0: the record is all there is of one.

    Without sections nothing is known: NaN.

    Returns
    -------
    Numbers by name. Of angles the mean is the direction of the mean of their unit vectors, zero
    where that has none, and the spread the root mean square of the chords from it, so that neither
    depends on where a turn begins. For covariances see `covariances`.
    """
    count = 2 * len(coordinates)
    if not len(sections):
        sections = np.full((1, count), math.nan)
    cycle = period or len(sections)
    whole, turning = sections[len(sections) % cycle :, :count], angles[:count]
    sines, cosines = sine_cosine(np.where(turning, whole, 0.0))
    sine, cosine = sines.mean(axis=0), cosines.mean(axis=0)
    square = cosine * cosine + sine * sine
    direction = np.where(square < DIRECTED * DIRECTED, 0.0, direction_angle(cosine, sine))
    mean = np.where(turning, direction, whole.mean(axis=0))
    halves, _ = sine_cosine(0.5 * np.where(turning, whole - direction, 0.0))
    chord = 2.0 * np.sqrt((halves * halves).mean(axis=0))
    spread = np.where(turning, chord, whole.std(axis=0))
    found: dict[str, float] = {}
    for name, centre, width in zip(names_of(coordinates), mean, spread, strict=True):
        found |= {f"{MEAN}{name}": float(centre), f"{SPREAD}{name}": float(width)}
    sines, _ = sine_cosine(np.where(turning, whole - direction, 0.0))
    away = np.where(turning, sines, whole - mean) / scales[:count]
    for name, product, one in zip(
        names_of(coordinates)[1:], covariances(away), scales[1:], strict=False
    ):
        found[f"{COVARIANCE}{name}"] = float(product * one)
    moves = spread > SAME * scales[:count]
    scattered = math.nan if period else independent(whole[:, moves], turning[moves])
    return found | {INDEPENDENT: scattered}


def covariances(away: Floats) -> Floats:
    """Return (states - 1,) covariances of each state with the mean of those before it.

    Each over the root mean square of either, where that is above one, so that it is known as well
    as the states are.

    away : (sections, states) of the sections from their mean, in what counts as one.
    """
    before = np.add.accumulate(away, axis=1)[:, :-1] / np.arange(1, away.shape[1])
    behind = away[:, 1:]
    larger = np.maximum((before * before).mean(axis=0), (behind * behind).mean(axis=0))
    return np.asarray((before * behind).mean(axis=0) / np.sqrt(np.maximum(larger, 1.0)))


DIRECTED = 1e-3
"""Length of a mean of unit vectors below which it has no direction."""
BATCHES = 8
"""Parts of a record whose means tell how sections depend on those before."""


def independent(sections: Floats, angles: Flags) -> float:
    """Return of how many independent sections means and spreads would scatter as these do.

    By batch means: those of dependent sections vary by more than the sections' variance over their
    number. NaN: fewer than two sections a batch.
    """
    size = len(sections) // BATCHES
    if size < 2:
        return math.nan
    columns = np.hstack([sections[:, ~angles], *sine_cosine(sections[:, angles])])
    columns = columns[len(columns) - BATCHES * size :]
    columns = columns - columns.mean(axis=0)
    columns = np.hstack([columns, columns**2 - (columns**2).mean(axis=0)])
    batches = columns.reshape(BATCHES, size, -1).mean(axis=1).var(axis=0, ddof=1)
    variance = columns.var(axis=0)
    varies = variance > 0.0
    dependence = size * batches[varies] / variance[varies]
    return float(len(columns) / max(1.0, dependence.max(initial=1.0)))
