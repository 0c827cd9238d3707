"""Choice of `"auto"`: the explicit method, but the implicit one while a run is stiff.

Every `LOOK` attempts a run is looked at. It may be stiff where the explicit method's steps are as
long as is stable: where they are about as long as the fastest part of the motion lasts, by the
largest eigenvalue of the Jacobian (Hairer and Wanner 1996, IV.2). It may also be where steps hardly
bring it on: where friction chatters, they are short for its kinks, well within stability. Then the
implicit method is tried on the stretch just passed, and takes over if so much fewer attempts
suffice that it is faster, though one takes four to nine times as long. Where it has taken over, the
explicit one is tried likewise.

All is counted in attempts of one lane, so that a job always chooses alike.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.integrators import AUTO, STIFF
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.run_kernel import run_kernel
from jointplay.solver.runs.stiffness import fastest_rate

EXPLICIT, IMPLICIT = AUTO.name, STIFF.name
LANE = 0
LOOK = {EXPLICIT: 2500, IMPLICIT: 500}
"""Attempts from one look to the next."""
FEWER = 20
"""The implicit method takes over where it needs that many times fewer attempts, at least."""
WORTH = 4
"""The explicit one where it needs no more attempts than that for one of the implicit method."""
WORTHWHILE = 20_000
"""Attempts that are still to be made, for as long as it goes on like this: else loading the
implicit kernel would take longer than the rest of the run."""
LIMITED = 2.0
"""Mean explicit attempt, by the time in which the fastest part of the motion changes, from which on
stability may limit it: 0.3 to 1.6 where impacts do, 3.5 where friction holds."""
FOLLOWED = 2.0 * WORTH
"""The same of the implicit method, up to which the explicit one may be as good."""
SLOW = 2.5e-4
"""Share of a period in which `LOOK` attempts hardly bring a run on."""
MOST_WAITS = 16
"""Looks that are skipped after trials in vain: twice as many after each, up to this many."""
TIGHTER = 1e-3
"""The implicit method gets this share of the tolerance: where friction chatters, its steps pass
over many kinks, so that at the same tolerance it loses up to 600 times the energy that it may."""
LEAST = 1e-13
"""Smallest tolerance of a job."""
MOST_REASONS = 4
"""Changes of the method that are told one by one."""
EARLIER = "changed before"


def is_open(admission: Admission) -> bool:
    """Whether the method may change as the run goes on."""
    possible = TIGHTER * admission.tolerance >= LEAST
    return bool(admission.job["method"] == "auto" and admission.method == EXPLICIT and possible)


def reason_for(admission: Admission) -> str:
    """Return why a run begins with its method."""
    if admission.job["method"] != "auto":
        return "asked for"
    if admission.method != EXPLICIT:
        return f"the tolerance is too large for '{EXPLICIT}'"
    return "not stiff" if is_open(admission) else f"the tolerance is too small for '{IMPLICIT}'"


def problem_for(problem: LaneProblem, method: str, admission: Admission) -> LaneProblem:
    """Return a job's problem with the tolerance that a method gets."""
    if method == admission.method:
        return problem
    return replace(problem, tolerance=TIGHTER * problem.tolerance)


def with_reason(reason: str, change: str) -> str:
    """Return the reason for the methods of a run whose method has just changed."""
    told = [*(each for each in reason.split("; ") if each != "not stiff"), change]
    return "; ".join(told if len(told) <= MOST_REASONS else [EARLIER, *told[-MOST_REASONS + 1 :]])


@dataclass
class Trial:
    """Facts of a run of one method by which a look decides."""

    bundle: Bundle
    problem: LaneProblem
    """Problem of the job, at its own tolerance."""
    admission: Admission
    row: Floats
    """Dense state, (1, width), where the stretch began that is looked at."""
    began: float
    """Its time, s."""

    @property
    def method(self) -> str:
        """Method of the run."""
        return self.bundle.kernel.tableau.name

    @property
    def other(self) -> str:
        """Method that might be better."""
        return IMPLICIT if self.method == EXPLICIT else EXPLICIT

    def is_suspected(self) -> bool:
        """Whether the other method might be better."""
        lane, attempts = self.bundle.lane(LANE), LOOK[self.method]
        passed = lane.time - self.began
        left = self.problem.duration - lane.time
        if self.method == IMPLICIT:
            return passed * fastest_rate(self.bundle, LANE) <= FOLLOWED * attempts
        if left * attempts < WORTHWHILE * passed:
            return False
        slow = passed < SLOW * float(lane.run["unit"])
        return slow or passed * fastest_rate(self.bundle, LANE) >= LIMITED * attempts

    def attempts(self) -> int:
        """Return the attempts of the other method on the stretch, 0 if they are too many."""
        other, attempts = self.other, LOOK[self.method]
        most = attempts // FEWER if other == IMPLICIT else attempts * WORTH
        problem = problem_for(self.problem, other, self.admission)
        kernel = run_kernel(self.admission, other)
        start = LaneStart.at_row(self.row[0], self.bundle.kernel.row)
        reached = self.bundle.lane(LANE).time
        bare = replace(
            problem, start=start, duration=reached, output_step=reached, samples=0, sections=0
        )
        trial = Bundle(kernel, [bare], watch=False)
        while trial.lane(LANE).running and trial.attempts < most:
            trial.advance(most - trial.attempts)
        return trial.attempts if trial.lane(LANE).status == Status.DONE else 0

    def reason(self, attempts: int) -> str:
        """Return why the other method goes on."""
        now = self.bundle.lane(LANE).time
        tolerance = problem_for(self.problem, self.other, self.admission).tolerance
        kind = "stiff" if self.other == IMPLICIT else "not stiff"
        return (
            f"{kind} from {now:.3g} s on: for the {now - self.began:.3g} s before, '{self.method}'"
            f" attempts {LOOK[self.method]} steps and '{self.other}' {attempts} at {tolerance:.2g}"
        )


class MethodChoice:
    """When a run is looked at, and what was seen; `examine` after every `allowance` of attempts."""

    def __init__(self, bundle: Bundle) -> None:
        self._begin(bundle)
        self.failures = self.waits = 0

    def _begin(self, bundle: Bundle) -> None:
        """Begin a stretch."""
        lane = bundle.lane(LANE)
        self.row, self.began = lane.row(), lane.time
        self.look_at = bundle.attempts + LOOK[bundle.kernel.tableau.name]

    def allowance(self, bundle: Bundle, budget: int) -> int:
        """Return how many attempts may be made before the run is looked at."""
        if not bundle.lane(LANE).running:
            return budget
        return min(budget, self.look_at - bundle.attempts)

    def is_due(self, bundle: Bundle) -> bool:
        """Whether the run is to be looked at."""
        return bundle.lane(LANE).running and bundle.attempts >= self.look_at

    def examine(
        self, bundle: Bundle, problem: LaneProblem, admission: Admission
    ) -> tuple[str, str]:
        """Return the method that goes on, and why; empty: the same as before.

        Compiles the implicit kernel where it is not cached, which takes seconds.
        """
        trial = Trial(bundle, problem, admission, self.row, self.began)
        found, waits, failures = 0, self.waits - 1, self.failures
        if self.waits <= 0 and trial.is_suspected():
            found = trial.attempts()
            failures = 0 if found else failures + 1
            waits = 0 if found else min(2**failures, MOST_WAITS)
        self.waits, self.failures = max(waits, 0), failures
        if found:
            return trial.other, trial.reason(found)
        self._begin(bundle)
        return "", ""

    def changed(self, bundle: Bundle) -> None:
        """Go on with the bundle of the other method."""
        self._begin(bundle)

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return what the next look depends on, as arrays of a checkpoint."""
        numbers = np.array([self.look_at, self.failures, self.waits])
        return {
            f"{name}/row": self.row,
            f"{name}/began": np.array(self.began),
            f"{name}/numbers": numbers,
        }

    def restore(self, saved: dict[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`."""
        self.row, self.began = saved[f"{name}/row"].copy(), float(saved[f"{name}/began"])
        self.look_at, self.failures, self.waits = map(int, saved[f"{name}/numbers"])
