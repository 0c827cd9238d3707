"""A run's reported extremes against its own samples, taken much closer than anything happens."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.lies.close_look import close_look
from benchmarks.lies.run import Finished, finish
from benchmarks.lies.sizes import sizes

Floats = NDArray[np.float64]

SPACING = 1e-7
"""s; longer where a run would have more than MOST_SAMPLES."""
MOST_SAMPLES = 200_000
STILL = 1e-9
"""Share of its size by which a channel must move, to be judged."""
ALLOWED = 1e-6
"""Share of its range by which an extreme may be off."""
ROUNDED = 4.0
"""Median second differences of samples CLOSER to each other that count as rounding: where a journal
is as close to its bearing's centre as its position is rounded, the direction of its slip is."""
ROUNDING = 2.0**-52
"""Rounding of positions of up to a metre, m."""
CLOSER, ABOUT = 2000, 0.1
"""Factor by which samples are closer about an extreme that none of the others reaches, and how many
spacings to either side."""


@dataclass(frozen=True)
class Extremes:
    """Outcome of a run's extremes.

    Attributes
    ----------
    ended : str
        ``judged``, or how the run failed.
    extremes, right : int
        Highest and lowest values of channels that move; those within ALLOWED.
    worst : float
        Largest miss, in ranges of the channel.
    where : str
        Channel, sense and values of that.
    """

    ended: str
    extremes: int = 0
    right: int = 0
    worst: float = 0.0
    where: str = ""


def extremes_of(job: dict[str, Any]) -> Extremes:
    """Run a job and compare its extremes with samples."""
    spacing = max(SPACING, job["duration"] / MOST_SAMPLES)
    finished = finish(job | {"certificate": False, "output_step": spacing})
    if not isinstance(finished, Finished):
        return Extremes(finished)
    values = finished.samples
    moving = np.ptp(values, axis=0) > STILL * sizes(finished.scene, finished.units, values)
    misses, said = [], []
    for column in np.flatnonzero(moving).tolist():
        name, sampled = finished.names[column], values[:, column]
        peak, spread = finished.peaks[name], float(np.ptp(sampled))
        for sense, value, time in (
            (1.0, peak.maximum, peak.maximum_time),
            (-1.0, peak.minimum, peak.minimum_time),
        ):
            seen = float((sense * sampled).max())
            miss = max(seen - sense * value, 0.0)
            if miss > ALLOWED * spread:
                seen_at = finished.time[int((sense * sampled).argmax())]
                miss = max(miss - rounding(finished, column, seen_at, spacing), 0.0)
            at = int(np.searchsorted(finished.time, time))
            near = sense * sampled[max(at - 3, 0) : at + 3]
            if finished.one_method and beyond(sense * value, near) > ALLOWED * spread:
                close = samples_about(finished, time, spacing)
                excess = beyond(sense * value, sense * close[:, column])
                miss = max(miss, excess - direction(finished, name, close))
            misses.append(miss / spread)
            said.append(f"{name} {value:.9g} at {time:.9g} s, sampled {sense * seen:.9g}")
    if not misses:
        return Extremes("nothing moves")
    worst = int(np.argmax(misses))
    right = sum(miss <= ALLOWED for miss in misses)
    return Extremes("judged", len(misses), right, float(misses[worst]), said[worst])


def samples_about(finished: Finished, time: float, spacing: float) -> Floats:
    """Return samples of all channels about a time, a CLOSER part of a spacing apart."""
    close, count = spacing / CLOSER, int(2.0 * ABOUT * CLOSER)
    first = max(time - ABOUT * spacing, 0.0)
    return close_look(finished.admission, finished.method, first, close, count)


def rounding(finished: Finished, column: int, time: float, spacing: float) -> float:
    """Return what a channel differs by from one of instants to the next that hardly differ.

    A kink there leaves all but one of the second differences small.
    """
    close = samples_about(finished, time, spacing)
    if len(close) < 3:
        return 0.0
    noise = ROUNDED * float(np.median(np.abs(np.diff(close[:, column], 2))))
    return max(noise, direction(finished, finished.names[column], close))


def direction(finished: Finished, name: str, close: Floats) -> float:
    """Return what slip is rounded by, m/s, where a journal is next to its bearing's centre."""
    joint, _, quantity = name.partition(".")
    if quantity != "slip_velocity" or f"{joint}.eccentricity_x" not in finished.names:
        return 0.0
    parts = ("eccentricity_x", "eccentricity_y", "eccentricity_rate_x", "eccentricity_rate_y")
    x, y, vx, vy = (close[:, finished.names.index(f"{joint}.{one}")] for one in parts)
    return float((np.hypot(vx, vy) * ROUNDING / np.maximum(np.hypot(x, y), ROUNDING)).max())


def beyond(highest: float, sampled: Floats) -> float:
    """Return by how much a value is beyond what samples about its time may rise to.

    Between two samples a channel may rise by half of what its slope changes by: a corner does.
    """
    bend = np.abs(np.diff(sampled, 2)).max() if len(sampled) > 2 else np.ptp(sampled)
    return max(float(highest - sampled.max() - 0.5 * bend), 0.0)
