"""Ideal followers that are pulled in a motion that drivers prescribe."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.observe import channel_values
from jointplay.solver.quantities.extremes import refined_peaks
from jointplay.solver.runs.followers import Pulled, first_pulls, followers, force_of, pulled
from jointplay.solver.runs.ideal.motion import IdealMotion

SCAN_A_PERIOD, MOST_SCANNED = 2000, 50_000
"""Instants at which pulls are first sought."""
AT_ONCE = 1000
"""Instants that are computed at once."""


def pulls_of_motion(motion: IdealMotion, duration: float) -> list[Pulled]:
    """Return the followers that are pulled within a period, or within `duration`, s."""
    names = followers(motion.scene)
    if not names:
        return []

    def forces(times: Floats) -> Floats:
        local = motion.local(np.ones(len(times)), times)
        values = channel_values(motion.numbers, motion.at(times, local))
        columns = [np.broadcast_to(values[force_of(name)], times.shape) for name in names]
        return np.stack(columns, axis=1)

    span = min(duration, motion.forces_period or duration)
    count = min(max(motion.instants(span, SCAN_A_PERIOD), 16), MOST_SCANNED)
    times = np.linspace(0.0, span, count + 1)
    found = np.concatenate([forces(times[i : i + AT_ONCE]) for i in range(0, len(times), AT_ONCE)])
    peaks = refined_peaks(names, forces, times, found)
    pushes = zip(names, found.T, strict=True)
    return pulled(peaks, {name: first_pulls(times, push, []) for name, push in pushes})
