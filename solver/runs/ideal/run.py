"""Runs a scene whose drivers leave no freedom: no integration, only exact motion at instants."""

import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.checkpoint import decode, encode
from jointplay.records.failure import SimulationFailed
from jointplay.records.peak import Peak
from jointplay.solver.mechanics.observe import channel_values
from jointplay.solver.quantities.extremes import refined_peaks, sampled_peak
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.followers import with_pulls
from jointplay.solver.runs.ideal.motion import IdealMotion
from jointplay.solver.runs.ideal.pulls import pulls_of_motion
from jointplay.solver.runs.ideal.refused import first_refusal
from jointplay.solver.runs.results import Slice, Summary
from jointplay.solver.scene.periods import drivers_period
from jointplay.solver.version import SOLVER_VERSION

_KIND = "ideal run"
SCAN_A_PERIOD = 2000
"""Instants at which extremes are first sought; parabolas and re-evaluation refine them."""
MOST_SCANNED = 200_000
ROWS_A_SLICE = 1000
"""Samples or sections that are computed at once."""


class IdealRun:
    """A run of an ideal mechanism: samples, then sections, then extremes."""

    def __init__(self, admission: Admission) -> None:
        self.admission = admission
        self.duration = float(admission.job["duration"])
        # not the admission's: the scene may give sections a period though nothing repeats
        period = drivers_period(admission.scene).seconds
        self.motion = IdealMotion(admission.scene, period, self.duration)
        self.motion.lost = first_refusal(self.motion, self.duration) or self.motion.lost
        self.names = [channel.name for channel in admission.channels]
        self.samples_done = 0
        self.sections_done = 0
        self.seconds = 0.0
        self.peaks: dict[str, Peak] = {}
        self.offset = admission.offset

    def slices(self) -> Iterator[Slice]:
        """See `Simulation.slices`."""
        lost = self.motion.lost
        while self.samples_done < self.admission.samples:
            begun = time.perf_counter()
            last = min(self.samples_done + ROWS_A_SLICE, self.admission.samples)
            times, local = self._sample_instants(self.samples_done, last)
            values, lost = self._up_to(times, local, lost)
            times = times[: len(values)]
            found = self._slice(times, values, np.empty(0), self.channels(np.empty(0)))
            self.samples_done += len(times)
            self.seconds += time.perf_counter() - begun
            yield found
            if lost is not None:
                raise lost
        while self.sections_done < self.admission.sections:
            begun = time.perf_counter()
            last = min(self.sections_done + ROWS_A_SLICE, self.admission.sections)
            index = np.arange(self.sections_done, last, dtype=np.float64)
            times, local = (
                self.offset + count * (self.admission.period or 0.0)
                for count in (index, np.remainder(index, self.motion.periods))
            )
            if self.motion.period is None:
                local = times
            sections = self.channels(times, local)
            found = self._slice(np.empty(0), self.channels(np.empty(0)), times, sections)
            self.sections_done = last
            self.seconds += time.perf_counter() - begun
            yield found
        self.peaks = self._extremes()

    def checkpoint(self) -> bytes:
        """See `Simulation.checkpoint`."""
        facts = {"done": [self.samples_done, self.sections_done], "seconds": self.seconds}
        return encode(_KIND, SOLVER_VERSION, facts, {})

    def restore(self, checkpoint: bytes) -> None:
        """Continue from a checkpoint."""
        facts, _ = decode(checkpoint, _KIND, SOLVER_VERSION)
        self.samples_done, self.sections_done = facts["done"]
        self.seconds = facts["seconds"]

    def summary(self) -> Summary:
        """See `Simulation.summary`; a run that was lost has the extremes up to there."""
        peaks = self.peaks
        if not peaks and self.samples_done:
            times, local = self._sample_instants(0, self.samples_done)
            settled = times >= self.admission.settle
            times, values = times[settled], self.channels(times[settled], local[settled])
            if len(times):
                peaks = {
                    name: sampled_peak(times, values[:, c]) for c, name in enumerate(self.names)
                }
        statistics: dict[str, Any] = {
            "steps": 0,
            "rejections": 0,
            "onsets": 0,
            "slow_impacts": 0,
            "rough_steps": 0,
            "smallest_step": None,
            "solver_seconds": self.seconds,
            "energy": None,
        }
        return Summary(peaks, statistics)

    def certificate(self) -> Certificate | None:
        """See `Simulation.certificate`."""
        if not self.admission.job["certificate"]:
            return None
        last = max(self.samples_done - 1, 0) * float(self.admission.job["output_step"])
        whole = self.samples_done == self.admission.samples
        reached = self.duration if whole else last
        pulled = pulls_of_motion(self.motion, reached) if reached > 0.0 else []
        return with_pulls(Certificate.of_exact(len(self.names), reached), pulled)

    def channels(self, times: Floats, local: Floats | None = None) -> Floats:
        """Return (instants, channels) at times in s; `local` is the time within the period."""
        if not len(times):
            return np.empty((0, len(self.names)))
        if local is None:
            local = self.motion.local(np.ones(len(times)), times)
        values = channel_values(self.motion.numbers, self.motion.at(times, local))
        columns = [np.broadcast_to(values[name], times.shape) for name in self.names]
        return np.stack(columns, axis=1)

    def _up_to(
        self, times: Floats, local: Floats, lost: SimulationFailed | None
    ) -> tuple[Floats, SimulationFailed | None]:
        """Return channels at the times before the motion is lost, and how it is lost."""
        while True:
            if lost is not None:
                count = int(np.searchsorted(times, lost.time))
                times, local = times[:count], local[:count]
            try:
                return self.channels(times, local), lost
            except SimulationFailed as earlier:
                lost = earlier

    def _sample_instants(self, first: int, last: int) -> tuple[Floats, Floats]:
        """Return times of samples, s, and the same within the period; the last is at the end."""
        step = self.admission.job["output_step"]
        index = np.arange(first, last, dtype=np.float64)
        times, local = index * step, self.motion.local(index, step)
        if last == self.admission.samples:
            times[-1] = self.duration
            local[-1] = self.motion.local(np.ones(1), self.duration)[0]
        return times, local

    def _slice(
        self, times: Floats, samples: Floats, section_times: Floats, sections: Floats
    ) -> Slice:
        reached = float(times[-1]) if len(times) else self.duration
        return Slice(
            time=reached,
            fraction=min(reached / self.duration, 1.0),
            first_sample=self.samples_done,
            sample_time=times,
            samples=samples,
            first_section=self.sections_done,
            section_time=section_times,
            sections=sections,
        )

    def _extremes(self) -> dict[str, Peak]:
        """Seek the extremes of every channel on the exact motion."""
        period, settle = self.motion.forces_period, self.admission.settle
        length = self.duration - settle
        span = min(length, period) if period else length
        count = max(self.motion.instants(span, SCAN_A_PERIOD), 16)
        times = settle + np.linspace(0.0, span, min(count, MOST_SCANNED) + 1)
        peaks = self._peaks(times)
        if length > span:  # angles that go on turning are extreme in the last period
            for name, late in self._peaks(times + (length - span)).items():
                early = peaks[name]
                low = min(early, late, key=lambda peak: peak.minimum)
                high = max(early, late, key=lambda peak: peak.maximum)
                peaks[name] = Peak(low.minimum, low.minimum_time, high.maximum, high.maximum_time)
        return peaks

    def _peaks(self, times: Floats) -> dict[str, Peak]:
        values = np.concatenate(
            [self.channels(times[i : i + ROWS_A_SLICE]) for i in range(0, len(times), ROWS_A_SLICE)]
        )
        return refined_peaks(self.names, self.channels, times, values)
