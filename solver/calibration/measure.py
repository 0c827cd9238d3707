"""Measured values of candidates in all cases."""

from collections.abc import Callable

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.calibration.case_measure import CaseMeasure, Looked
from jointplay.solver.calibration.problem import Calibration

Measure = Callable[[Floats], Floats]
"""Takes candidates (n, parameters), returns the values of all targets (n, targets)."""


class Measurement:
    """Measures candidates in all cases."""

    def __init__(
        self,
        calibration: Calibration,
        *,
        every: bool,
        looked: Looked = lambda ended, steps: None,
    ) -> None:
        """Look at every target, or only at those that are fitted."""
        self.cases: list[tuple[int, CaseMeasure, list[int]]] = []
        """Index of each case, and where its values stand among all targets."""
        self.count = 0
        for index, case in enumerate(calibration.cases):
            chosen = [i for i, target in enumerate(case.targets) if every or target.weight > 0.0]
            if chosen:
                columns = [self.count + number for number in chosen]
                self.cases.append((index, CaseMeasure(calibration, case, chosen, looked), columns))
            self.count += len(case.targets)

    def prepare(self) -> None:
        """Compile what the first candidates need, and refuse what cannot be measured.

        Raises
        ------
        InvalidInput
            A channel that drivers prescribe.
        LimitExceeded
            The scene's equations are too long to compile.
        """
        problems = [
            Problem(f"/cases/{index}{problem.pointer}", problem.detail)
            for index, case, _ in self.cases
            for problem in case.prepare()
        ]
        if problems:
            raise InvalidInput(problems)

    def __call__(self, candidates: Floats) -> Floats:
        """Return (n, targets): NaN where a run failed or a target is not looked at."""
        out = np.full((len(candidates), self.count), np.nan)
        for _, case, columns in self.cases:
            out[:, columns] = case(candidates)
        return out
