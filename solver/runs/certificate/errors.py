"""Error bars of channels, and the horizon of the motion: until when its own are small."""

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.runs.certificate import estimate
from jointplay.solver.runs.certificate.companions import TWIN, Companions
from jointplay.solver.runs.certificate.drawn_rates import drawn_rates
from jointplay.solver.runs.certificate.steepness import steepness


def errors_of(
    companions: Companions,
    columns: NDArray[np.int64],
    values: Floats,
    scales: Floats,
    safety: float,
    channels: int,
) -> tuple[Floats, float]:
    """Return error bars (instants, columns), in the columns' units, and the horizon, s.

    Parameters
    ----------
    columns
        Channels of the kernel's block: first those that were asked for, so many `channels`, then
        the motion.
    values : (companions, instants, columns)
        What each companion has there.
    scales : (instants, columns)
        Sizes that errors are small against, see `estimate.last_small`.
    safety
        Times that companions are apart which an error may be.
    """
    time = companions.instants.time[: companions.compared]
    times = np.where(drawn_rates(companions), max(estimate.UNCONTROLLED, safety), safety)
    apart = times[:, None] * estimate.apart(values)
    near = estimate.near_claims(apart[:, channels:], scales[-1, channels:])
    steep = steepness(companions, safety, columns, values[TWIN - 1], near)
    error = estimate.around(np.maximum(apart, steep))
    horizon = float(time[estimate.last_small(error[:, channels:], scales[:, channels:])])
    later = estimate.around(estimate.UNCONTROLLED * estimate.parted(values))
    np.copyto(error, np.fmax(error, later), where=(time > horizon)[:, None])
    return error, horizon
