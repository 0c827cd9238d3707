"""Each lane's run, beside the work array, and buffers of what the loop hands out."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.records.impact import IMPACT


class Status(IntEnum):
    """Status of a lane."""

    RUNNING = 0
    DONE = 1
    UNDERFLOW = 2
    STEP_LIMIT = 3
    ONSET_LOST = 4
    IDLE = 5
    NO_PROGRESS = 6


RUNNING = int(Status.RUNNING)
"""As a number: NumPy takes ten microseconds to compare an array with a member of an enumeration."""


class SectionKind(IntEnum):
    """Kind of event that makes a Poincare section."""

    CRANK = 0
    ONSET = 1
    CROSSING = 2


SAMPLES, SECTIONS = 0, 1
"""Kinds of dense rows; index of the pairs in a run, and of buffers."""
NO_PAIR = -1
PACE_STEPS, SLOWEST_PACE = 200_000, 1e-5
"""Fewer periods of the fastest driver than SLOWEST_PACE in PACE_STEPS steps are no progress: the
run ends."""


class Run:
    """Type of a lane's run: its clock, what it shall hand out, and what it has counted."""

    status: int
    """Member of `Status`."""
    periods: int
    """Whole periods that have passed."""
    next: NDArray[np.int64]
    """Index of the next sample, and of the next section."""
    stop: NDArray[np.int64]
    """Index behind the last sample, and behind the last section."""
    due: NDArray[np.float64]
    """Local time of the next sample, and of the next section, s."""
    filled: NDArray[np.int64]
    """Rows of samples, and of sections, in the buffers."""
    impacts: int
    """Contacts in the buffer."""
    kept: int
    """Accepted steps in the buffer."""
    growths: int
    """Growths of the tangent in the buffer."""
    rejections: int
    onsets: int
    attended: int
    """Attempts after which the lane was looked after by itself; few in steady motion."""
    slow: int
    """Onsets slower than the floor of their impact rate."""
    rough: int
    """Steps that were found to be rough inside; see `solver.kernels.loop.extremes.roughness`."""
    landing: int
    """Joint on whose onset the step is to end; `NO_PAIR`: none."""
    landings: int
    """Attempts at that onset."""
    period: float
    """Common period of the clocks, or the scene's time scale, s."""
    unit: float
    """Period of the fastest driver, or the scene's time scale, s."""
    common: int
    """Whether all clocks repeat after `period`."""
    duration: float
    """s."""
    output_step: float
    """s."""
    smallest_step: float
    """A step below it ends the run, s."""
    pace_time: float
    """Time at the last check of the pace, s."""
    section_kind: int
    """Member of `SectionKind`."""
    section_index: int
    """Joint with play, or row of the channel block, that events are of."""
    section_offset: float
    """Local time of sections at a crank angle, s."""
    section_value: float
    section_sense: float
    """1: crossings from below count; -1: from above."""
    section_turn: float
    """Distance of the levels at which an angle crosses; 0: there is one level."""
    section_from: float
    """Time from which events count, s."""
    tangent_forgets: int
    """Whole periods after which the tangent forgets latched impact rates; 0: never."""


DTYPE = np.dtype(
    [
        (name, np.float64 if "float" in kind else np.int64, (2,) if "NDArray" in kind else ())
        for name, kind in Run.__annotations__.items()
    ],
    align=True,  # else a device takes eight loads for a number
)

GROWTH = np.dtype([("end", np.float64), ("logarithm", np.float64)], align=True)
"""Growth of a tangent: end of its time, s, and logarithm of the factor."""


class Buffers(NamedTuple):
    """Output of the loop for Python to read, by lane."""

    rows: NDArray[np.float64]
    """Dense rows of samples and of sections, (2, lanes, capacity, width)."""
    impacts: NDArray[np.void]
    """Contacts that ended, (lanes, capacity) of `IMPACT`."""
    growths: NDArray[np.void]
    """(lanes, capacity) of `GROWTH`; without capacity there are no tangents."""
    steps: NDArray[np.float64]
    """Accepted steps of the lanes that keep them, the first ones, (lanes, capacity, width)."""

    @classmethod
    def of(
        cls, lanes: int, capacity: int, width: int, *, tangents: bool, steps: tuple[int, int, int]
    ) -> Buffers:
        """Return empty buffers; `steps` : lanes, capacity and width of accepted steps."""
        return cls(
            np.zeros((2, lanes, capacity, width)),
            np.zeros((lanes, capacity), IMPACT),
            np.zeros((lanes, capacity if tangents else 0), GROWTH),
            np.zeros(steps),
        )
