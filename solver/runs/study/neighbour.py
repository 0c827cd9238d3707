"""The start of a point that follows its neighbour: its last state, at the same crank angle."""

from dataclasses import replace
from typing import Final

from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import LaneStart
from jointplay.solver.runs.study.plan import Study

WHOLE: Final = 1e-9
"""Share of a period: a state so close to whole periods is one at crank angle 0."""


def neighbours_start(study: Study, bundle: Bundle, lane: int, following: int) -> LaneStart:
    """Return where another point starts after that which a lane has computed.

    With sections at another crank angle than 0, or at events, a run ends within a period. Then the
    other one starts before its time 0, where its drivers are as far in their period.
    """
    last, found = bundle.lane(lane), bundle.state_of(lane)
    share = last.number("time") / float(last.run["period"])
    if not last.run["common"] or abs(share - round(share)) <= WHOLE:
        return found
    return replace(found, period=-1, time=share % 1.0 * float(study.period[following]))
