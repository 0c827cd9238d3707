"""A run of a scene that moves freely somewhere, in slices of its steps."""

import time
from collections.abc import Iterator

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.checkpoint import decode, encode
from jointplay.solver.kernels.loop.runs import SAMPLES, SECTIONS, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.hand_over import handed_over
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.mechanics.section_states import states_at_section
from jointplay.solver.runs import stiff_method
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.budget import SliceBudget
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.certificate.survey import Survey
from jointplay.solver.runs.dense_output.columns import most_steps, number_of
from jointplay.solver.runs.dense_output.intervals import IntervalExtremes
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.followers import Followers, with_pulls
from jointplay.solver.runs.lane_results import (
    failure_of,
    peaks_of,
    statistics_of,
)
from jointplay.solver.runs.results import Slice, Summary
from jointplay.solver.runs.run_kernel import run_kernel
from jointplay.solver.runs.sampled_extremes import SampledExtremes
from jointplay.solver.runs.settled_peaks import SettledPeaks
from jointplay.solver.version import SOLVER_VERSION

_KIND = "simulation"
_INTERVALS = "intervals"
_SETTLED = "settled"
_SAMPLED = "sampled"
_CHOICE = "choice"
LANE = 0
"""The lane of the trajectory; its bits do not depend on what the seven others do."""


class DynamicRun:
    """A run of a scene that moves freely somewhere: lane 0 of a bundle, companions beside it."""

    def __init__(self, admission: Admission) -> None:
        self.admission = admission
        job = admission.job
        self.problem = LaneProblem(
            admission.scene,
            job["duration"],
            admission.tolerance,
            job["output_step"],
            admission.samples,
            admission.sections,
            admission.offset,
            start=_start_of(admission),
            step=job["step"],
        )
        self.seconds = 0.0
        self.most_steps = most_steps(admission)
        self._start(admission.method, stiff_method.reason_for(admission))

    def _start(self, method: str, reason: str) -> None:
        """Begin with a method."""
        formulation = self.admission.job["formulation"]
        problem = stiff_method.problem_for(self.problem, method, self.admission)
        kernel = run_kernel(self.admission, method)
        bundle = Bundle(kernel, [problem], keep_steps=1)
        certified = self.admission.job["certificate"]
        survey = Survey(bundle, problem, formulation) if certified else None
        # compiling may have ended the run, with what it had so far
        self.reason, self.kernel, self.bundle, self.survey = reason, kernel, bundle, survey
        rows, channels = self.kernel.rows, self.admission.channels
        self.columns = np.array([rows.index(c.name) for c in channels], dtype=np.int64)
        self.followers = Followers(self.admission.scene, rows)
        self.samples_done = 0
        self.sections_done = 0
        self.steps_kept = 0
        self.intervals: IntervalExtremes | None = None
        self.settled: SettledPeaks | None = None
        if self.admission.settle:
            names, stop = [channel.name for channel in channels], self.admission.job["duration"]
            replay = Replay(self.admission, method)
            self.settled = SettledPeaks(replay, names, self.admission.settle, float(stop))
        self.sampled = SampledExtremes(len(channels), self.admission.settle or 0.0)
        is_open = stiff_method.is_open(self.admission)
        self.choice = stiff_method.MethodChoice(bundle) if is_open else None
        """Changes the method as the run goes on; none: it keeps its own."""

    def slices(self) -> Iterator[Slice]:
        """See `Simulation.slices`."""
        budget = SliceBudget()
        while self._runs():
            begun = time.perf_counter()
            if self.choice is not None and self.choice.is_due(self.bundle):
                self._reconsider(self.choice)
            before, allowed = self.bundle.attempts, budget.attempts
            advancing = time.perf_counter()
            if self.choice is not None:
                allowed = self.choice.allowance(self.bundle, allowed)
            (self.survey or self.bundle).advance(allowed)
            found = self._slice()
            now = time.perf_counter()
            self.seconds += now - begun
            budget.adapt(self.bundle.attempts - before, now - advancing)
            yield found
        if self.bundle.lane(LANE).status != Status.DONE:
            raise failure_of(self.bundle, LANE, self.admission.tolerance, self.problem.scene)

    def _reconsider(self, choice: stiff_method.MethodChoice) -> None:
        """Go on with the other method from here, if it is better."""
        method, change = choice.examine(self.bundle, self.problem, self.admission)
        if not method:
            return
        before = stiff_method.problem_for(self.problem, self.kernel.tableau.name, self.admission)
        problem = stiff_method.problem_for(self.problem, method, self.admission)
        kernel = run_kernel(self.admission, method)
        sharper = before.tolerance / problem.tolerance
        bundle = handed_over(self.bundle, kernel, problem, sharper)
        for part in (self.intervals, self.settled):
            if part is not None:
                part.go_on_with(self.admission, method)
        if self.survey is not None:
            self.survey.go_on_with(bundle, problem)
        self.kernel, self.bundle = kernel, bundle
        self.reason = stiff_method.with_reason(self.reason, change)
        choice.changed(bundle)

    def checkpoint(self) -> bytes:
        """See `Simulation.checkpoint`."""
        facts = {
            "method": self.kernel.tableau.name,
            "reason": self.reason,
            "attempts": self.bundle.attempts,
            "solver_seconds": self.seconds,
            "samples": self.samples_done,
            "sections": self.sections_done,
            "steps": self.steps_kept,
            "pulls": self.followers.first,
        }
        arrays = self.survey.checkpoint() if self.survey else {}
        if self.choice is not None:
            arrays |= self.choice.state(_CHOICE)
        if self.intervals is not None:
            arrays |= self.intervals.state(_INTERVALS)
        if self.settled is not None:
            arrays |= self.settled.state(_SETTLED)
        arrays |= self.sampled.state(_SAMPLED)
        arrays |= self.bundle.state("lanes")
        return encode(_KIND, SOLVER_VERSION, facts, arrays)

    def restore(self, checkpoint: bytes) -> None:
        """Continue from a checkpoint."""
        facts, saved = decode(checkpoint, _KIND, SOLVER_VERSION)
        self.seconds = facts["solver_seconds"]
        if facts["method"] != self.kernel.tableau.name:
            self._start(facts["method"], facts["reason"])
        self.reason = facts["reason"]
        self.bundle.restore(saved, "lanes")
        self.bundle.attempts = facts["attempts"]
        if self.choice is not None:
            self.choice.restore(saved, _CHOICE)
        if any(name.startswith(f"{_INTERVALS}/") for name in saved):
            self.intervals = IntervalExtremes(self.admission, facts["method"])
            self.intervals.restore(saved, _INTERVALS)
        if self.settled is not None:
            self.settled.restore(saved, _SETTLED)
        self.sampled.restore(saved, _SAMPLED)
        if self.survey:
            self.survey.restore(saved)
        self.samples_done, self.sections_done = facts["samples"], facts["sections"]
        self.steps_kept = facts["steps"]
        self.followers.first = facts["pulls"]

    def summary(self) -> Summary:
        """See `Simulation.summary`."""
        names = [channel.name for channel in self.admission.channels]
        statistics = statistics_of(self.bundle, LANE) | {
            "method": self.kernel.tableau.name,
            "method_reason": self.reason,
            "solver_seconds": self.seconds,
        }
        settled = self.settled
        peaks = peaks_of(self.bundle, LANE, names) if settled is None else settled.peaks()
        return Summary(self.sampled.held_against(peaks), statistics)

    def certificate(self) -> Certificate | None:
        """See `Simulation.certificate`."""
        if self.survey is None:
            return None
        found = self.survey.certificate(self.admission.channels)
        return with_pulls(found, self.followers.pulled(self.bundle, LANE))

    def _runs(self) -> bool:
        if self.survey is not None:
            return self.survey.goes_on
        return self.bundle.lane(LANE).running

    def _slice(self) -> Slice:
        samples, _ = self._observe(SAMPLES)
        sections, section_time = self._observe(SECTIONS)
        first_sample, first_section = self.samples_done, self.sections_done
        self.samples_done += len(samples)
        sample_time = np.arange(first_sample, self.samples_done) * self.admission.job["output_step"]
        self.followers.examine(self.bundle, LANE, sample_time)
        self.sections_done += len(sections)
        reached = self.bundle.lane(LANE).time
        duration = self.admission.job["duration"]
        if self.samples_done == self.admission.samples:
            sample_time[-1:] = reached = duration
        self.sampled.add(sample_time, samples)
        slowest = min(reached, self.survey.time) if self.survey else reached
        steps, intervals = self._steps()
        return Slice(
            time=reached,
            fraction=min(slowest / duration, 1.0),
            first_sample=first_sample,
            sample_time=sample_time,
            samples=samples,
            first_section=first_section,
            section_time=section_time,
            sections=sections,
            impacts=self.bundle.impacts(LANE),
            steps=steps,
            intervals=intervals,
        )

    def _steps(self) -> tuple[Floats, Floats]:
        """Return the steps that are kept, with their method; intervals of those that are not."""
        steps = self.bundle.steps(LANE)
        count = max(min(len(steps), self.most_steps - self.steps_kept), 0)
        self.steps_kept += count
        method = np.full((count, 1), number_of(self.kernel.tableau.name))
        kept = np.concatenate([steps[:count], method], axis=1)
        found = self._intervals(steps[count:])
        if self.settled is not None:
            self.settled.add(steps)
        return kept if self.most_steps else np.empty((0, 0)), found

    def _intervals(self, steps: Floats) -> Floats:
        """Return the extremes of intervals that steps complete which are not kept."""
        if self.intervals is None:
            if not len(steps):
                return np.empty((0, 1 + 2 * len(self.columns)))
            self.intervals = IntervalExtremes(self.admission, self.kernel.tableau.name)
        found = self.intervals.add(steps)
        if not self.bundle.lane(LANE).running:
            found = np.concatenate([found, self.intervals.end()])
        return found[found[:, 0] < self.samples_done]

    def _observe(self, kind: int) -> tuple[Floats, Floats]:
        rows = self.bundle.rows(kind, LANE)
        return self.bundle.observe(LANE, rows, self.columns), self.bundle.times(LANE, rows)


def _start_of(admission: Admission) -> LaneStart | None:
    """Return where a run begins instead of at its scene's start."""
    state = admission.job.get("state")
    if state is None:
        return None
    return LaneStart.at_section(np.array(state), len(states_at_section(admission.scene)))
