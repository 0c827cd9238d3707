"""A stretch at a finer tolerance behind a point's record, to see whether its exponent holds.

A tangent vector follows the trajectory's steps without an error of its own: where contact is hard
and rare, its exponent may be of the steps' making, however steady it is. So the lane goes on for a
share of the record, in far smaller steps; `solver.nonlinear.lyapunov.confirmed` compares the two.
"""

import math

from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.runs.study.indicators import LATE
from jointplay.solver.runs.study.problem import ENDLESS

FINER = 1e-2
"""The finer tolerance, in the job's."""
STRICTEST = 1e-13
"""Tolerances are no smaller: rounding would be followed."""
SHARE, FEWEST = 0.25, 50
"""Length of the stretch: a share of the record, but as many periods if the record has them."""


def go_on_finer(bundle: Bundle, lane: int, tolerance: float, period: float, record: int) -> int:
    """Let a lane that is done go on with smaller steps.

    Parameters
    ----------
    tolerance
        Of the record.
    period
        s.
    record
        Sections of the record.

    Returns
    -------
    Periods since the lane's start after which the growth of its tangent counts.
    """
    at = bundle.lane(lane)
    finer = tolerance / max(FINER * tolerance, min(STRICTEST, tolerance))
    for name in ("weight", "full", "fastest"):
        at[name] = finer * at[name]
    for name in ("tangent", "tangent_impact_rate"):  # its length is measured by the weights
        at[name] = at[name] / finer
    first = math.ceil(at.time / period - LATE)
    periods = min(record, max(math.ceil(SHARE * record), FEWEST))
    bundle.extend(lane, (first + periods) * period, ENDLESS)
    return first
