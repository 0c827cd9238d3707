"""A stored run read at any time: finds the steps that a window needs, and asks for the rest."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.resolution import Resolution
from jointplay.records.works import WORKS
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.ends import ROUNDING, NoSuchWindow, ends_of
from jointplay.worker.windows.intervals import Intervals
from jointplay.worker.windows.pieces import between, folded, merged
from jointplay.worker.windows.question import Answer, Question, together

AT_ONCE = 200_000
"""Steps of one question, each counted once and `A_CHANNEL` for each channel: 0.3 s of computing."""
A_CHANNEL = 0.1
A_SHARP_CHANNEL = 0.02
"""The same where extremes are sharp, and not evaluated where they are: so they are of a window
that is more than one question."""
MOST_PIECES = 40
"""Questions of one window: others' are answered between them."""
MOST_STEPS = 800_000
"""Steps of a ledger of energy."""
MOST_INSTANTS = 200_000
"""Instants of an ideal motion in one window: as long."""
PARTS = 8
"""Pieces of a step on a path: no corner is seen between them."""
EVEN = 10_000
"""Instants of a path of an ideal motion."""


def at_once(channels: int, a_channel: float) -> int:
    """Return how many steps one question reads of so many channels."""
    return max(int(AT_ONCE / (1.0 + a_channel * channels)), 1)


class Trajectory:
    """A stored run at any time, between its samples too.

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
        """Time up to which the run is known, s.

        That of the last sample, and of one that ended before its time that of its last step.
        """
        reader, samples = self._reader, self._reader.samples
        if self._intervals is not None:
            samples = self._intervals.behind
        last = float(reader.history([], samples - 1, samples)[0][0]) if samples else 0.0
        ended_early = reader.sealed and not reader.complete and self._intervals is None
        return max(last, reader.steps.end) if ended_early and reader.steps is not None else last

    @property
    def covered(self) -> float:
        """Time up to which values at any instant are known, s; none of them is computed here."""
        if self._is_motion:
            return self.reached
        steps = self._reader.steps
        return 0.0 if steps is None else min(steps.end, self.reached)

    @cached_property
    def _intervals(self) -> Intervals | None:
        stored, steps = self._reader.intervals, self._reader.steps
        end = steps.end if steps is not None else 0.0
        return None if stored is None else Intervals(self._reader, stored, end)

    @property
    def _is_motion(self) -> bool:
        """The run needs no steps: its motion is known as it is."""
        return bool(self._reader.attributes.get("exact") == "motion")

    @property
    def _finest(self) -> Resolution:
        return Resolution("motion" if self._is_motion else "steps")

    def ends(self, start: float | None, stop: float | None) -> tuple[float, float]:
        """Return both ends, s, of what is known of a window, or raise `NoSuchWindow`."""
        return ends_of(self.reached, start, stop)

    def edges(self, start: float | None, stop: float | None, points: int) -> Floats:
        """Return edges (at most `points` + 1,), s, between which extremes are known exactly.

        They are even where steps are kept, and samples' times where they are not, from that before
        the window to that behind it. One edge, and nothing between, where the run has nothing of
        the window.
        """
        try:
            start, stop = self.ends(start, stop)
        except NoSuchWindow:
            return np.array([max(start or 0.0, 0.0)])
        whole = self._intervals
        if whole is None or stop <= whole.begin or not stop > start:
            return np.linspace(start, stop, points + 1) if stop > start else np.array([start, stop])
        _, times = whole.ends(max(start, whole.begin), stop)
        share = max(whole.begin - start, 0.0) / (stop - start)
        even = min(round(points * share), points - 1) if share else 0
        count = min(points - even, len(times) - 1)
        chosen = np.unique(np.linspace(0, len(times) - 1, count + 1).astype(np.int64))
        before = np.linspace(start, times[0], even + 1)[:-1] if even else np.empty(0)
        return np.concatenate([before, times[chosen]])

    def values(self, names: Sequence[str], times: Floats) -> Answer:
        """Return channels (m, names) at ascending times (m,), s: the bits that samples have."""
        if not len(times):
            return Answer(np.empty((0, len(names))))
        start, stop, count = float(times[0]), float(times[-1]), len(times)
        pieces = self._pieces(start, stop, count, at_once(len(names), A_CHANNEL))
        if isinstance(pieces, str):
            return Answer(None, refused=pieces)
        behind = np.searchsorted(times, [high for _, high in pieces], side="right")
        behind[-1] = len(times)
        answers = []
        for first, last in pairwise([0, *behind]):
            if last > first:
                steps = self._steps(float(times[first]), float(times[last - 1]))
                question = self._question(names, steps, times=times[first:last])
                answers.append(self._ask(question))
        return replace(together(answers), resolution=self._finest)

    def extremes(self, names: Sequence[str], edges: Floats) -> Answer:
        """Return extremes (bins, names, 4) between edges: lowest, its time, highest, its time."""
        if len(edges) == 1:
            return Answer(np.empty((0, len(names), 4)))
        whole = self._intervals
        if whole is None or edges[-1] <= whole.begin * (1.0 + ROUNDING):
            return self._in_steps(names, edges)
        found = np.full((len(edges) - 1, len(names), 4), np.nan)
        spacing = float(self._reader.attributes["job"]["output_step"])
        known = Answer(found)
        inner = edges[edges < whole.begin]
        if len(inner):
            known = self._in_steps(names, np.append(inner, whole.begin))
            if known.values is None:
                return known
            found[: len(inner)] = known.values
        begin = max(len(inner) - 1, 0)
        beyond = whole.extremes(tuple(names), edges[begin:])
        found[begin:] = merged(found[begin:], beyond)
        since = max(whole.begin, float(edges[0]))
        return replace(
            known,
            values=found,
            whole_from=since,
            resolution=Resolution("intervals", spacing, since),
        )

    def _in_steps(self, names: Sequence[str], edges: Floats) -> Answer:
        start, stop, instants = float(edges[0]), float(edges[-1]), 8 * len(edges)
        every = len(self._reader.channels)  # bits of a channel do not depend on what is asked
        pieces = self._pieces(start, stop, instants, at_once(every, A_CHANNEL))
        evaluated = not isinstance(pieces, str) and len(pieces) == 1
        if not evaluated:
            pieces = self._pieces(start, stop, instants, at_once(every, A_SHARP_CHANNEL))
        if isinstance(pieces, str):
            return Answer(None, refused=pieces)
        ranges = self._ranges(names, start, stop)
        answers, begins = [], []
        for low, high in pieces:
            parts = edges if len(pieces) == 1 else between(edges, low, high)
            steps = self._steps(low, high)
            about = {"edges": parts, "ranges": ranges, "evaluated": evaluated}
            answers.append(self._ask(self._question(names, steps, **about)))
            begins.append(parts[:-1])
        found = together(answers)
        if found.values is None:
            return found
        values = folded(edges, np.concatenate(begins), found.values)
        return replace(found, values=values, resolution=self._finest)

    def works(self, start: float, stop: float) -> Answer:
        """Return times (k,) and works since the start (k, 4) as one table: s, then J.

        Times are those at which steps end, and both ends of the window; within a step, a work is
        taken to grow evenly.
        """
        pieces = self._pieces(start, stop, 0, MOST_STEPS // MOST_PIECES)
        if isinstance(pieces, str):
            return Answer(None, refused=pieces)
        stored = self._reader.steps
        if stored is None:
            return Answer(None, refused="An ideal motion has no ledger of its energy.")
        first, last = stored.around(start, stop)
        answers = [
            self._ask(self._question((), stored.read(k, min(k + AT_ONCE, last))))
            for k in range(first, last, AT_ONCE)
        ]
        found = together(answers)
        if found.values is None:
            return found
        ends = np.append(stored.begin(first), found.values[:, 0])
        sums = np.cumsum(np.vstack([np.zeros(len(WORKS)), found.values[:, 1:]]), axis=0)
        times = np.concatenate([[start], ends[(ends > start) & (ends < stop)], [stop]])
        curves = [np.interp(times, ends, column) for column in sums.T]
        since = [times, *(curve - curve[0] for curve in curves)]
        return replace(found, values=np.column_stack(since))

    def instants(self, start: float, stop: float, most: int) -> Floats | None:
        """Return times, s: `PARTS` in each step, or even ones of a motion without steps."""
        pieces = self._pieces(start, stop, most, AT_ONCE)
        if isinstance(pieces, str) or len(pieces) > 1:
            return None
        steps = self._steps(start, stop)
        if steps is None or self._reader.steps is None:
            return np.linspace(start, stop, min(most, EVEN))
        begins = self._reader.steps.begins(steps)
        begins = np.unique(np.concatenate([[start], begins[(begins > start) & (begins < stop)]]))
        parts = min(most // (len(begins) + 1), PARTS)
        if parts < 1:
            return None
        lengths = np.diff(np.append(begins, stop))[:, None]
        return np.append((begins[:, None] + lengths * (np.arange(parts) / parts)).ravel(), stop)

    def _question(self, names: Sequence[str], steps: Floats | None, **asked: Any) -> Question:
        attributes = self._reader.attributes
        methods = tuple(attributes.get("methods", ()))
        return Question(dict(attributes["job"]), tuple(names), steps, methods=methods, **asked)

    def _pieces(
        self, start: float, stop: float, instants: int, steps: int
    ) -> list[tuple[float, float]] | str:
        """Return the times between which so many steps are read at once, or why there are none."""
        if start < 0.0 or stop > self.reached * (1.0 + ROUNDING):
            return f"The run has been computed from 0 to {self.reached:.9g} s."
        if self._is_motion:
            too_many = instants > MOST_INSTANTS
            refusal = f"An answer has at most {MOST_INSTANTS} instants; ask for fewer."
            return refusal if too_many else [(start, stop)]
        stored = self._reader.steps
        if stored is None or not stored.count:
            return "The job keeps no steps; see its field 'steps_limit'."
        if stop > stored.end * (1.0 + ROUNDING):
            limit = self._reader.attributes["job"].get("steps_limit", 0)
            sentence = f"Steps are kept up to {stored.end:.6g} s, within {limit:g} bytes"
            return f"{sentence}; beyond there are samples, and extremes between them."
        first, last = stored.around(start, stop)
        if last - first > MOST_PIECES * steps:
            sentence = f"The window has {last - first} steps; at most {MOST_PIECES * steps}"
            return f"{sentence} are read. A shorter one is exact."
        cuts = [stored.begin(k) for k in range(first + steps, last, steps)]
        return list(pairwise([start, *(cut for cut in cuts if start < cut < stop), stop]))

    def _steps(self, start: float, stop: float) -> Floats | None:
        """Return the steps around a piece of a window; None: the motion needs none."""
        stored = self._reader.steps
        return None if stored is None else stored.read(*stored.around(start, stop))

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
