"""The start of a point that follows its neighbour: its last state, at the same crank angle."""

import math
from dataclasses import replace
from typing import Final

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.runs.geared_wheels import driven_wheels_back_after
from jointplay.solver.runs.study.plan import Study

WHOLE: Final = 1e-9
"""Share of a period: a state so close to whole periods is one at crank angle 0."""


def neighbours_start(study: Study, bundle: Bundle, lane: int, following: int) -> LaneStart:
    """Return where another point starts after that which a lane has computed.

    With sections at another crank angle than 0, or at events, a run ends within a period. Then the
    other one starts before its time 0, where its drivers are as far in their period. So it does
    where wheels behind gears are not back after the periods of the run: as many before its time 0
    as make them so, unless the run itself had fewer.
    """
    last, found = bundle.lane(lane), bundle.state_of(lane)
    if not last.run["common"]:
        return found
    share = last.number("time") / float(last.run["period"])
    ends = abs(share - round(share)) <= WHOLE
    gone = int(last.run["periods"]) + (round(share) if ends else math.floor(share))
    period = float(study.period[following])
    back_after = driven_wheels_back_after(study.point_scene(following), period)
    if back_after > max(gone, 1):
        back_after = 1
    if ends:
        return replace(found, period=-(-gone % back_after))
    return replace(found, period=gone % back_after - back_after, time=share % 1.0 * period)
