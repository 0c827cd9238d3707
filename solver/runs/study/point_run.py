"""A point of a study while it is computed or waits, and tallies of the time after settling."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Flags, Floats
from jointplay.records.point import PointEnd
from jointplay.solver.lanes.bundle import LaneState
from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.nonlinear.settling import SETTLINGS, Settling
from jointplay.solver.runs.study.indicators import RECURS
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.statistics import OF_CHANNELS, OF_CONTACTS, Grid


@dataclass
class PointRun:
    """A point, and what it has handed out so far."""

    point: int
    chain: int
    position: int
    """In the chain."""
    start: LaneStart | None = None
    """Its neighbour's last state; none: the scene's start rule."""
    settled: int = -1
    """Periods left out, once that is known; -1 before."""
    reached: int = 0
    """Periods of the present leg's end."""
    taken: int = 0
    """Sections handed out."""
    seen: list[Floats] = field(default_factory=list)
    """States at sections, (sections, states) each, that settling or indicators still need."""
    moments: list[Floats] = field(default_factory=list)
    """Times of recorded sections at events, (sections,) each, s."""
    growth: list[Floats] = field(default_factory=list)
    """Logarithms of the tangent's growth in each recorded period."""
    finer: list[Floats] = field(default_factory=list)
    """The same behind the record, at the finer tolerance."""
    finer_from: int = 0
    """Periods after which that counts."""
    ended: PointEnd | None = None
    """Its end, once its record is full; the indicators are still missing."""
    rest: list[Floats] = field(default_factory=list)
    """Its state, (states,), if it has come to rest at the end of its record."""
    lasting: str = ""
    """Contacts that lasted throughout the record, as a sentence."""
    tried: list[PointEnd] = field(default_factory=list)
    """Ends of the point's runs from earlier starts, where it has several."""
    tallies: list[Floats] = field(default_factory=list)
    """Tallies of the job's statistics, in its order; see `begin_tallies`."""
    sampled: int = 0
    """Samples that they have had."""
    extremes: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    """State of what seeks its extremes after settling; see `point_extremes`."""
    lane: LaneState | None = field(default=None, repr=False)
    """Where it had come to when a restart point was made, as `Bundle.take_up` has it."""
    settling: Settling | None = field(default=None, repr=False)

    def has_settled(self, scales: Floats, angles: Flags, most: int) -> bool:
        """Look at the sections of the last leg. Returns whether the motion has settled."""
        found = self.settling or Settling(scales, RECURS, max(most, 1), angles)
        if found.result is None:
            states = np.concatenate([np.zeros((0, len(scales))), *self.seen])
            found.feed(states[len(found.sections) :])
        self.settling = found
        return found.result is not None and found.result.code != SETTLINGS["unsettled"]


SAME = 1e-5
"""Share of a step: a sample closer than that to an end of the stretch lies on it."""


@dataclass(frozen=True)
class Stretch:
    """Time after settling, and the samples in it: at whole multiples of the step.

    The first may lie at the start; none lies at the end, which repeats the start of whole periods.
    """

    start: float
    """s, as the other times."""
    end: float
    step: float
    first: int
    """Index of the first sample."""
    grid: Grid

    def up_to(self, reached: float) -> "Stretch":
        """Return the part of it up to where a run has come, which ends early with its events."""
        early = reached < self.end - SAME * self.step
        return replace(self, end=reached) if early else self


def stretch_of(study: Study, point: int) -> Stretch:
    """Return the stretch of a point's statistics."""
    start, end = float(study.settle[point]), float(study.duration[point])
    per_period = int(study.job["samples_per_period"])
    step = float(study.period[point]) / per_period
    first, stop = (math.ceil(time / step - SAME) for time in (start, end))
    grid = Grid(stop - first, per_period, study.ends_with_events)
    return Stretch(start, end, step, first, grid)


def begin_tallies(study: Study, run: PointRun, pairs: int) -> None:
    """Give a point the tallies of its statistics: of channels, of contacts, as the job has them."""
    grid, channels = stretch_of(study, run.point).grid, len(study.channels)
    run.tallies = [
        OF_CHANNELS[name].begin(grid, channels) if name in OF_CHANNELS else np.zeros(pairs)
        for name in study.statistics
    ]


def take_samples(study: Study, run: PointRun, values: Floats) -> None:
    """Take (samples, channels) values that follow those before; one at the end is left out."""
    grid = stretch_of(study, run.point).grid
    values = values[: grid.samples - run.sampled]
    if not len(values):
        return
    for name, tally in zip(study.statistics, run.tallies, strict=True):
        if name in OF_CHANNELS:
            OF_CHANNELS[name].add(tally, values, run.sampled, grid)
    run.sampled += len(values)


def take_contacts(study: Study, run: PointRun, contacts: NDArray[np.void], reached: float) -> None:
    """Take contacts that ended, or last at the end of the run; it has come to `reached`, s."""
    stretch = stretch_of(study, run.point).up_to(reached)
    for name, tally in zip(study.statistics, run.tallies, strict=True):
        if name in OF_CONTACTS:
            OF_CONTACTS[name].add(tally, contacts, stretch.start, stretch.end)


def statistics_in(
    study: Study, run: PointRun, pairs: tuple[str, ...], reached: float
) -> dict[str, float]:
    """Return the statistics of a point that ended at `reached`, s, by their names.

    `solver.statistics` says how they are named.
    """
    stretch = stretch_of(study, run.point).up_to(reached)
    found: dict[str, float] = {}
    for name, tally in zip(study.statistics, run.tallies, strict=True):
        if name in OF_CHANNELS:
            parts = tuple(channel.name for channel in study.channels)
            values = OF_CHANNELS[name].value(tally, run.sampled)
        else:
            parts = pairs
            values = OF_CONTACTS[name].value(tally, stretch.start, stretch.end)
        found |= {f"{part}.{name}": float(x) for part, x in zip(parts, values, strict=True)}
    return found
