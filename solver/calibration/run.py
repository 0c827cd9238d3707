"""A calibration in slices, for a worker: one process, interrupted and continued at any of them."""

import time
from collections.abc import Iterator
from typing import Any

import numpy as np
from greenlet import getcurrent, greenlet

from jointplay.records.arrays import Floats
from jointplay.records.checkpoint import decode, encode
from jointplay.records.point import PointEnd, StudySlice
from jointplay.solver.calibration.calibrate import calibrate, costs_of
from jointplay.solver.calibration.length import most_candidates, most_runs
from jointplay.solver.calibration.measure import Measurement
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.calibration.plan import CalibrationStudy, best_of
from jointplay.solver.version import SOLVER_VERSION

_KIND = "calibration"
NO_PEAKS = np.empty((0, 4))


class CalibrationRun:
    """The block of a calibration; `slices` computes it, `checkpoint` keeps the costs so far.

    The search asks for costs and cannot be left in between; it runs in a greenlet, which hands
    back to `slices` whenever the lanes were looked at.  Search and spread follow from the document,
    so that one that is continued asks for the costs that are kept again, in the same order.
    """

    def __init__(
        self, study: CalibrationStudy, block: int, checkpoint: bytes | None = None
    ) -> None:
        """Begin the calibration, or take up after the last costs that were known."""
        self.study = study
        self.seconds = 0.0
        """Spent computing since this object was made."""
        self.steps = 0
        """Accepted in the runs that ended since then."""
        self._costs: list[Floats] = []
        self._spent = self._kept = (0, 0)
        """Runs that ended, and their steps: of the whole calibration, and behind `_costs`."""
        self._reported = 0.0
        if checkpoint is not None:
            facts, saved = decode(checkpoint, _KIND, SOLVER_VERSION)
            ends = np.cumsum(facts["lengths"], dtype=int)
            self._costs = np.split(saved["costs"], ends)[:-1]  # the last one is behind them all
            self._spent = self._kept = (facts["runs"], facts["steps"])
        self._most = _most_runs(study)

    def slices(self) -> Iterator[StudySlice]:
        """Yield how far the search is after each look at the lanes, and at last what was found.

        Raises
        ------
        InvalidInput
            A target that no parameter can move.
        LimitExceeded
            The scene's equations are too long to compile.
        NothingFits
            Every run of the search failed.
        """
        calibration = self.study.calibration
        fitted, every = (
            Measurement(calibration, every=all_of_them, looked=self._looked)
            for all_of_them in (False, True)
        )
        every.prepare()
        yield self._slice(started=(0,))
        kept = iter(list(self._costs))
        compute = costs_of(calibration, fitted)

        def cost(unit: Floats) -> Floats:
            known = next(kept, None)
            if known is None:
                known = compute(unit)
                self._costs.append(known)
                self._kept = self._spent
            return known

        search = greenlet(calibrate)
        worked = time.process_time()
        found = search.switch(calibration, cost, every, self._report)
        while not search.dead:
            self.seconds += time.process_time() - worked
            yield self._slice()
            worked = time.process_time()
            found = search.switch()
        self.seconds += time.process_time() - worked
        self._reported = 1.0
        yield self._slice(ended=(self._end(found),))

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        runs, steps = self._kept
        lengths = [len(costs) for costs in self._costs]
        facts = {"lengths": lengths, "runs": runs, "steps": steps}
        arrays = {"costs": np.concatenate([np.empty(0), *self._costs])}
        return encode(_KIND, SOLVER_VERSION, facts, arrays)

    def _looked(self, ended: int, steps: int) -> None:
        self._spent = (self._spent[0] + ended, self._spent[1] + steps)
        self.steps += steps
        getcurrent().parent.switch()

    def _report(self, done: float, note: str) -> None:
        self._reported = done

    def _slice(self, started: tuple[int, ...] = (), ended: tuple[PointEnd, ...] = ()) -> StudySlice:
        fraction = 1.0 if ended else max(self._reported, min(self._spent[0] / self._most, 0.999))
        return StudySlice(fraction, started, (), ended)

    def _end(self, found: Outcome) -> PointEnd:
        until = float(self.study.duration[0])
        names = self.study.calibration.space.names
        numbers: dict[str, Any] = {"steps": float(self._spent[1]), "cost": found.cost}
        numbers |= {best_of(name): float(at) for name, at in zip(names, found.best, strict=True)}
        return PointEnd(0, "", "", until, NO_PEAKS, numbers, {}, document=found.document())


def _most_runs(study: CalibrationStudy) -> int:
    """Return how many runs search and spread have at most, with the last look at all targets."""
    calibration = study.calibration
    count = len(calibration.space.names)
    candidates = most_candidates(calibration.search, calibration.spread, count)
    return sum(most_runs(candidates, [case.targets for case in calibration.cases]))
