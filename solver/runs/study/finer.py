"""A stretch at a finer tolerance behind a point's record, to see whether its exponent holds.

A tangent vector follows the trajectory's steps without an error of its own: where contact is hard
and rare, its exponent may be of the steps' making, however steady it is. So the lane goes on for a
share of the record, in far smaller steps; `solver.nonlinear.lyapunov` compares the two exponents.
"""

import math

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.study.indicators import LATE
from jointplay.solver.runs.study.problem import ENDLESS
from jointplay.solver.scene.document import Scene

FINER = 1e-2
"""The finer tolerance, in the job's: at a tenth, an exponent that falls by three with every tenth
would still be called right within three errors."""
STRICTEST = 1e-13
"""Tolerances are no smaller: rounding would be followed."""
SHARE, FEWEST = 1 / 16, 8
"""Length of the stretch: a share of the record, but as many periods if the record has them. Where
that leaves open whether neighbours part it is doubled, up to the length of the record."""
COST: float = FINER**-0.2
"""Steps of a finer period, in those of the record: methods that carry tangents are of order 5."""


def periods_of(record: int) -> int:
    """Return the length of the stretch behind so many sections."""
    return min(record, max(math.ceil(SHARE * record), FEWEST))


def go_on_finer(
    bundle: Bundle, lane: int, scene: Scene, tolerance: float, period: float, record: int
) -> int:
    """Let a lane that is done go on with smaller steps.

    Parameters
    ----------
    scene
        That the lane runs.
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
    return go_on_for(bundle, lane, scene, period, periods_of(record))


def go_on_for(bundle: Bundle, lane: int, scene: Scene, period: float, periods: int) -> int:
    """Let a lane that is done go on for some periods, of so many s each.

    Returns the periods since its start after which they begin.
    """
    first = math.ceil(bundle.lane(lane).time / period - LATE)
    bundle.extend(lane, scene, (first + periods) * period, ENDLESS)
    return first


def go_on_longer(
    bundle: Bundle, lane: int, scene: Scene, first: int, period: float, record: int
) -> bool:
    """Double the stretch that began after `first` periods.

    Returns whether the record is longer than it.
    """
    periods = round(float(bundle.lane(lane).run["duration"]) / period) - first
    if periods >= record:
        return False
    bundle.extend(lane, scene, (first + min(2 * periods, record)) * period, ENDLESS)
    return True
