"""Courses of forces that refuse the arguments to which drivers bring them."""

import math

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import SimulationFailed
from jointplay.solver.runs.ideal.motion import IdealMotion
from jointplay.solver.scene.domains import bounded_courses

SCAN_A_PERIOD, MOST_SCANNED = 2000, 50_000
"""Instants that are looked at first."""
AT_ONCE = 1000
"""Instants that are computed at once."""
HALVINGS = 40
"""Times that the span between two instants is halved."""


def first_refusal(motion: IdealMotion, duration: float) -> SimulationFailed | None:
    """Return what ends a run of a duration, s, where a course is not given; None if none does."""
    found = []
    for name, course in bounded_courses(motion.scene).items():
        time = _refused_at(motion, name, duration)
        if time is not None:
            first, last = course.domain or (-math.inf, math.inf)
            sentence = (
                f"At t = {time:.9g} s the argument of force '{name}' leaves its course, which is"
                f" given from {first:g} to {last:g} and refuses others. Give more knots, a shorter"
                " duration, or another 'outside'."
            )
            found.append(SimulationFailed("outside-of-a-function", sentence, time))
    return min(found, key=lambda one: one.time, default=None)


def _refused_at(motion: IdealMotion, name: str, duration: float) -> float | None:
    """Return when a force is first no number, s; None: it is one as far as the motion goes."""
    reached = duration if motion.lost is None else motion.lost.time
    span = min(reached, motion.forces_period or reached)
    count = min(max(motion.instants(span, SCAN_A_PERIOD), 16), MOST_SCANNED)
    times = np.linspace(0.0, span, count, endpoint=motion.lost is None)
    for first in range(0, count, AT_ONCE):
        refused = _refused(motion, name, times[first : first + AT_ONCE])
        if refused.any():
            at = first + int(refused.argmax())
            low, high = float(times[max(at - 1, 0)]), float(times[at])
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                inside = not _refused(motion, name, np.array([middle]))[0]
                low, high = (middle, high) if inside else (low, middle)
            return high
    return None


def _refused(motion: IdealMotion, name: str, times: Floats) -> Flags:
    """Return (n,) whether a force is no number at times (n,), s."""
    local = motion.local(np.ones(len(times)), times)
    power = motion.at(times, local).forces.elements[name].power
    found: Flags = np.isnan(np.broadcast_to(power, times.shape))
    return found
