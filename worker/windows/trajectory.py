"""A stored run read at any time: finds the steps that a window needs, and asks for the rest."""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.question import Answer, Question

MOST_STEPS = 300_000
"""Steps of one window, each counted once and a tenth for each channel: some 0.4 s of computing."""
A_CHANNEL = 0.1
MOST_INSTANTS = 200_000
"""Instants of an ideal motion in one window: as long."""
PARTS = 8
"""Pieces of a step on a path: no corner is seen between them."""
EVEN = 10_000
"""Instants of a path of an ideal motion."""
ROUNDING = 1e-12
"""Share of a time by which a window may go beyond what is kept."""


class Trajectory:
    """What one run stored, between its samples too.

    Parameters
    ----------
    reader
        Of the run.
    ask
        Answers a question: in this process, or in another.
    """

    def __init__(self, reader: ResultReader, ask: Callable[[Question], Answer]) -> None:
        self._reader = reader
        self._ask = ask

    @cached_property
    def reached(self) -> float:
        """Time of the last sample that can be read, s."""
        samples = self._reader.samples
        return float(self._reader.history([], samples - 1, samples)[0][0]) if samples else 0.0

    def values(self, names: Sequence[str], times: Floats) -> Answer:
        """Return channels (m, names) at ascending times (m,), s: the bits that samples have."""
        if not len(times):
            return Answer(np.empty((0, len(names))))
        refused, steps = self._steps(names, float(times[0]), float(times[-1]), len(times))
        if refused:
            return Answer(None, refused=refused)
        return self._ask(Question(self._job, tuple(names), steps, times=times))

    def extremes(self, names: Sequence[str], edges: Floats) -> Answer:
        """Return extremes (bins, names, 4) between edges: lowest, its time, highest, its time."""
        start, stop = float(edges[0]), float(edges[-1])
        refused, steps = self._steps(names, start, stop, 8 * len(edges))
        if refused:
            return Answer(None, refused=refused)
        ranges = self._ranges(names, start, stop)
        return self._ask(Question(self._job, tuple(names), steps, edges=edges, ranges=ranges))

    def instants(self, start: float, stop: float, most: int) -> Floats | None:
        """Return times, s: `PARTS` in each step, or even ones of a motion without steps."""
        refused, steps = self._steps((), start, stop, most)
        if refused:
            return None
        if steps is None or self._reader.steps is None:
            return np.linspace(start, stop, min(most, EVEN))
        begins = self._reader.steps.begins(steps)
        begins = np.unique(np.concatenate([[start], begins[(begins > start) & (begins < stop)]]))
        parts = min(most // (len(begins) + 1), PARTS)
        if parts < 1:
            return None
        lengths = np.diff(np.append(begins, stop))[:, None]
        return np.append((begins[:, None] + lengths * (np.arange(parts) / parts)).ravel(), stop)

    @property
    def _job(self) -> dict[str, object]:
        return dict(self._reader.attributes["job"])

    def _steps(
        self, names: Sequence[str], start: float, stop: float, instants: int
    ) -> tuple[str, Floats | None]:
        """Return the steps around a window, or a sentence that says why there are none."""
        if start < 0.0 or stop > self.reached * (1.0 + ROUNDING):
            return f"The run has been computed from 0 to {self.reached:.9g} s.", None
        if self._reader.attributes.get("exact") == "motion":
            if instants > MOST_INSTANTS:
                return f"An answer has at most {MOST_INSTANTS} instants; ask for fewer.", None
            return "", None
        most = int(MOST_STEPS / (1.0 + A_CHANNEL * len(names)))
        return self._stored_steps(start, stop, most)

    def _stored_steps(self, start: float, stop: float, most: int) -> tuple[str, Floats | None]:
        stored = self._reader.steps
        if stored is None or not stored.count:
            return "The job keeps no steps, only samples; see its field 'steps_limit'.", None
        if stop > stored.end * (1.0 + ROUNDING):
            limit = self._reader.attributes["job"].get("steps_limit", 0)
            sentence = f"Steps are kept up to {stored.end:.6g} s, within {limit:g} bytes"
            return f"{sentence}; beyond there are samples. See 'steps_limit'.", None
        first, last = stored.around(start, stop)
        if last - first > most:
            sentence = f"The window has {last - first} steps, of so many channels at most {most}"
            return f"{sentence} are read at once; a shorter one is exact.", None
        return "", stored.read(first, last)

    def _ranges(self, names: Sequence[str], start: float, stop: float) -> Floats:
        """Return the range (names,) of each channel, against which extremes are sharp."""
        peaks = self._reader.peaks()
        if peaks:
            found = np.array([peaks[name].maximum - peaks[name].minimum for name in names])
        else:
            first, last = self._reader.between(start, stop)
            columns = self._reader.history(names, first, last)[1]
            found = np.array([np.ptp(columns[name]) if last > first else 0.0 for name in names])
        return np.where(np.isfinite(found), found, 0.0)
