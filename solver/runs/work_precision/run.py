"""Every run of an accuracy-study, one after the other, each compared with the reference."""

from collections.abc import Iterator

import numpy as np

from jointplay.records.checkpoint import decode, encode
from jointplay.records.failure import SimulationFailed
from jointplay.records.point import PointEnd, StudySlice
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.runs.work_precision.plan import REFERENCES, Run, WorkPrecisionStudy
from jointplay.solver.runs.work_precision.timed_run import TimedRun
from jointplay.solver.version import SOLVER_VERSION

_KIND = "accuracy study"
KNOWN = 1e-8
"""Runs are compared as long as the references differ by less, relative to the scene's scales."""
MOST_REFERENCES = 20.0
FEWEST = 1e7
"""A run is given up after as many evaluations as that many references take, or as these."""
NO_PEAKS = np.empty((0, 4))


class WorkPrecisionRun:
    """The block of an accuracy-study; `slices` computes it, `checkpoint` keeps the runs that ended.

    But for their seconds, runs give the same whenever and wherever they are computed: a run is
    given up after a number of evaluations, not after a time. One that was interrupted begins
    anew, so that its seconds are those of one machine.
    """

    def __init__(
        self, study: WorkPrecisionStudy, block: int, checkpoint: bytes | None = None
    ) -> None:
        """Begin the block, or take up after the last run that ended; see `StudyRun`."""
        self.study = study
        self.runs = study.runs
        self.seconds = 0.0
        """Spent computing since this object was made."""
        self.steps = 0
        """Accepted since then."""
        self._next = 0
        self._most = np.inf
        self._given_up: list[str] = []
        self._time = self._scales = np.empty(0)
        self._reference = np.empty((0, 0))
        self._weights = np.array([run.evaluations(float(study.period[0])) for run in self.runs])
        if checkpoint is not None:
            facts, saved = decode(checkpoint, _KIND, SOLVER_VERSION)
            self._time, self._scales = saved["time"], saved["scales"]
            self._reference = saved["reference"]
            self._next, self._most, self._given_up = facts["next"], facts["most"], facts["given_up"]

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every run has ended.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        study = self.study
        scene, kernels = study.point_scene(0), dict[str, Kernel]()
        while self._next < len(self.runs):
            point, run = self._next, self.runs[self._next]
            if run.method in self._given_up:
                self._next += 1
                yield self._slice(0.0, ended=(self._end(point, _given_up(run), {}),))
                continue
            if run.method not in kernels:
                formulation = study.job["formulation"]
                kernels[run.method] = ready_kernel(scene, formulation, run.method, alone=True)
            timed = TimedRun(scene, kernels[run.method], run, self._until)
            yield self._slice(0.0, started=(point,))
            while True:
                before = timed.seconds, timed.steps
                going = timed.advance()
                self.seconds += timed.seconds - before[0]
                self.steps += timed.steps - before[1]
                if not going or timed.evaluations > self._most:
                    break
                yield self._slice(timed.fraction)
            end = self._ended(point, run, timed, going=going)
            self._next += 1
            yield self._slice(0.0, ended=(end,))

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        facts = {"next": self._next, "most": self._most, "given_up": self._given_up}
        arrays = {"time": self._time, "scales": self._scales, "reference": self._reference}
        return encode(_KIND, SOLVER_VERSION, facts, arrays)

    def _slice(
        self, under_way: float, started: tuple[int, ...] = (), ended: tuple[PointEnd, ...] = ()
    ) -> StudySlice:
        """`under_way` : 0..1 of the next run."""
        done = float(self._weights[: self._next].sum())
        if self._next < len(self.runs):
            done += under_way * float(self._weights[self._next])
        return StudySlice(min(done / float(self._weights.sum()), 1.0), started, (), ended)

    def _ended(self, point: int, run: Run, timed: TimedRun, *, going: bool) -> PointEnd:
        """Return how a run ended; a reference is kept, and the window cut to what both know."""
        found = timed.cost()
        time, states = timed.samples()
        if going:
            failure: SimulationFailed | None = _given_up(run, timed)
            # what jobs may not ask for, or is tighter, says nothing of looser tolerances
            if run.admitted and not run.reference:
                self._given_up.append(run.method)
        else:
            failure = timed.failure()
        if point == 0:
            self._most = max(MOST_REFERENCES * timed.evaluations, FEWEST)
            self._time, self._reference, self._scales = time, states, timed.scales()
        elif point < len(REFERENCES):
            known = min(len(states), len(self._reference))
            apart = np.abs(states[:known] - self._reference[:known]) / self._scales
            unknown = np.flatnonzero(~(apart.max(axis=1) <= KNOWN))
            known = int(unknown[0]) if len(unknown) else known
            self._time, self._reference = self._time[:known], self._reference[:known]
        if point > 0 and (failure is None or run.reference):
            known = len(self._reference)
            found["window"] = float(self._time[-1]) if known else 0.0
            if found["window"] > 0.0:  # at the start all runs are the same
                error = (states[:known] - self._reference) / self._scales
                found["error"] = float(np.sqrt(np.mean(error**2)))
        return self._end(point, failure, found)

    def _end(
        self, point: int, failure: SimulationFailed | None, found: dict[str, float]
    ) -> PointEnd:
        how = (failure.code, failure.detail, failure.time) if failure else ("", "", self._until)
        return PointEnd(point, *how, NO_PEAKS, found, {})

    @property
    def _until(self) -> float:
        return float(self.study.job["duration"])


def _given_up(run: Run, timed: TimedRun | None = None) -> SimulationFailed:
    if timed is None:
        sentence = f"Left out: '{run.method}' was given up at a looser tolerance or a longer step."
        return SimulationFailed("left-out", sentence, 0.0)
    at = timed.bundle.lane(0).time
    return SimulationFailed(
        "given-up",
        f"Given up at t = {at:.9g} s after {timed.evaluations} evaluations, many times what the"
        " reference takes. Another method is better here.",
        at,
    )
