"""The estimated error of a trajectory over time, from how far its companions are apart.

At each instant: the largest distance of the trajectory and those that start beside it from one
another and from tighter ones, between the latter, and of looser ones, by how much looser they are.
SAFETY makes it cover the true error (docs/certificate.md has how often it does). A law may be so
steep that channels change by more where the state is as wrong as that: then that counts. An error
changes sign, and a force is wrong where an impact is late: so the largest within REACH instants to
either side is taken.

Beyond its horizon a trajectory is one of many that are as good; what they have in common, shares of
time, is what can be said of the motion.
"""

import warnings
from itertools import combinations

import numpy as np

from jointplay.records.arrays import Flags, Floats, Integers
from jointplay.solver.runs.certificate.companions import (
    LADDER,
    LOOSER,
    PERTURBED,
    TIGHTER,
    TIGHTEST,
    TWIN,
)

SAFETY, UNCONTROLLED = 3.0, 6.0
"""Estimated errors by what companions are apart; the second where steps are fixed: there errors are
as late as contacts are, by parts of a step that do not follow its length; where a latched rate is a
draw; and beyond the horizon, where companions are draws of an outcome that none need have."""
REACH = 2
"""Instants."""
CONVERGED = 0.05
"""Share of its scale below which the error of a coordinate must stay."""
LASTING = 8
"""Instants."""


def apart(values: Floats) -> Floats:
    """Return how far companions are apart, (instants, channels), in the channels' units.

    values : (7, instants, channels) of lanes 1 to 7; NaN where one was left behind.
    Infinite where no two of different tolerances are left to compare.
    """
    lanes = dict(enumerate(values, start=1))
    tightest, twin = lanes[TIGHTEST], lanes[TWIN]
    alike = {*PERTURBED, TWIN}
    pairs = combinations((TIGHTEST, TIGHTER, *PERTURBED, TWIN), 2)
    distances = [np.abs(lanes[a] - lanes[b]) for a, b in pairs if not alike.issuperset((a, b))]
    for lane in LOOSER:
        times = LADDER[lane - 1]
        distances.append(np.abs(lanes[lane] - tightest) / times)
        distances.append(np.abs(lanes[lane] - twin) / (times - 1.0))
    with warnings.catch_warnings():  # of instants that no lane reached
        warnings.simplefilter("ignore", RuntimeWarning)
        largest: Floats = np.nanmax(distances, axis=0)
    largest = np.where(np.isnan(largest), np.inf, largest)
    for lane in PERTURBED:
        largest = np.fmax(largest, np.abs(lanes[lane] - twin))
    return largest


def parted(values: Floats) -> Floats:
    """Return the largest distance of any two companions, (instants, channels).

    Beyond the horizon chance decides what becomes of each: the distance of a looser one does not
    tell how much looser it is. values : as `apart` takes them.
    """
    with warnings.catch_warnings():  # of instants that no lane reached
        warnings.simplefilter("ignore", RuntimeWarning)
        largest: Floats = np.nanmax(values, axis=0) - np.nanmin(values, axis=0)
    return largest


def around(apart: Floats) -> Floats:
    """Return the largest values within REACH instants, (instants, channels)."""
    largest = apart.copy()
    for shift in range(1, REACH + 1):
        np.maximum(largest[shift:], apart[:-shift], out=largest[shift:])
        np.maximum(largest[:-shift], apart[shift:], out=largest[:-shift])
    return largest


def within(error: Floats, scales: Floats) -> Flags:
    """Return where errors are small, (instants, channels).

    error : (instants, channels). scales : sizes that errors are compared with, (instants, channels)
    or (channels,).
    """
    return np.asarray((error <= CONVERGED * scales) & (error < np.inf))


def last_small(error: Floats, scales: Floats) -> int:
    """Return the index of the last instant until which all errors are small.

    error : (instants, channels). scales : (instants, channels) sizes that errors are compared with
    if that instant is the last one: they do not become smaller from one instant to the next.
    """
    small = within(np.maximum.accumulate(error), scales)
    return int(_last(np.all(small, axis=1)))


def scales_from(scales: Floats, last: int) -> Floats:
    """Return sizes of errors, (instants, channels): until the index `last` those that are there."""
    return np.concatenate([np.broadcast_to(scales[last], scales[:last].shape), scales[last:]])


def near_claims(apart: Floats, scales: Floats) -> Flags:
    """Return instants, (instants,), whose companions count where the motion may be converged.

    apart : (instants, channels) of the motion. scales : as in `within`.
    """
    claimed = within(around(apart), scales).all(axis=1)
    return np.asarray(around(np.asarray(claimed, np.float64)) > 0.0)


def until(error: Floats, scales: Floats, time: Floats) -> Floats:
    """Return the time, s, until which each channel's error stays small from the start on.

    error, scales : as `last_small` takes them, of which each channel counts alone.
    """
    return np.asarray(time[_last(within(np.maximum.accumulate(error), scales))])


def _last(flags: Flags) -> Integers:
    """Return where along the first axis the last flag is set, 0 where none is."""
    last = len(flags) - 1 - flags[::-1].argmax(axis=0)
    return np.asarray(np.where(flags.any(axis=0), last, 0))


def spans(small: Flags, time: Floats) -> list[list[float]]:
    """Return first and last times, s, of the spans in which the motion is converged.

    small : (instants, channels). The first span begins with the run and ends at the horizon; it
    may be one instant. Where friction and impacts take more than chaos tears apart, companions come
    together again: later spans have LASTING instants at least, so that chance meetings are none.
    """
    all_small = np.concatenate([[False], small.all(axis=1), [False]])
    edges = np.flatnonzero(np.diff(all_small.astype(np.int8)))
    pairs = edges.reshape(-1, 2)
    later = [(a, b) for a, b in pairs if a > 0 and b - a >= LASTING]
    first = [(a, b) for a, b in pairs if a == 0] or [(0, 1)]
    return [[float(time[a]), float(time[b - 1])] for a, b in first + later]


BINS = 16


def histogram(values: Floats, time: Floats) -> tuple[Floats, Floats, Floats]:
    """Return bins' edges and shares of time in them with their standard deviation over lanes.

    (BINS + 1, channels), (BINS, channels), (BINS, channels). values : (lanes, instants, channels);
    a lane with a NaN was left behind and does not count. time : (instants,) s, of which each stands
    for half the time to its neighbours.
    """
    whole = values[~np.isnan(values).any(axis=(1, 2))]
    lanes, _, channels = whole.shape
    if not lanes:
        nothing = np.full((BINS, channels), np.nan)
        return np.full((BINS + 1, channels), np.nan), nothing, nothing
    weights = np.ones(1)
    if len(time) > 1:
        weights = np.gradient(time)
        weights[[0, -1]] *= 0.5
    low, high = whole.min(axis=(0, 1)), whole.max(axis=(0, 1))
    width = np.where(high > low, high - low, 1.0)
    bins = np.minimum((BINS * (whole - low) / width).astype(np.int64), BINS - 1)
    indices = bins * channels + np.arange(channels)
    each = np.broadcast_to(weights[:, None], indices.shape[1:]).ravel()
    counts = [np.bincount(at.ravel(), each, BINS * channels) for at in indices]
    shares = np.array(counts).reshape(lanes, BINS, channels) / weights.sum()
    edges = low + (high - low) * np.linspace(0.0, 1.0, BINS + 1)[:, None]
    return edges, shares.mean(axis=0), shares.std(axis=0, ddof=1 if lanes > 1 else 0)
