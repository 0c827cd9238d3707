"""Instants of a film: those of its frames, and those between, which trails are made of."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.figures import between_samples, sampling, scene_facts
from jointplay.figures.animation.pace import LASTING, Pace
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

MOST_FRAMES: Final = 300
"""Frames of one film: each is kept, some 2 MB, until the film is written."""
PARTS: Final = 6
"""Instants of a frame: trails have no corners."""
_LEAD = 40
"""Frames before the first, of which a trail is there already."""


@dataclass(frozen=True)
class Instants:
    """Times of a film [s].

    Parameters
    ----------
    all
        (m,) ascending, `PARTS` for each frame, from before the first one on.
    frames
        (n,) index of each frame among them.
    rate
        Seconds of motion in one second of film; 0 where that changes, or nothing moves.
    """

    all: Floats
    frames: range
    rate: float

    @property
    def times(self) -> Floats:
        """(n,) time of each frame."""
        return self.all[self.frames.start :: PARTS]

    def first(self) -> "Instants":
        """Return those of the first frame alone."""
        return Instants(self.all[: self.frames.start + 1], self.frames[:1], 0.0)


def instants(source: Source, selection: Selection, pace: Pace) -> Instants:
    """Choose the instants of a film of a window, by default of the drivers' first turn in it.

    Raises
    ------
    NotDrawable
        There are no samples in the window, or it has more frames than `MOST_FRAMES`.
    """
    if pace.impact_to_impact:
        return _impacts(source, selection)
    start, stop = _ends(source, selection)
    rate = pace.rate or min((stop - start) / LASTING, 1.0)
    step = rate / pace.frames_per_second
    count = max(math.ceil((stop - start) / step - 1e-9), 1) if step > 0.0 else 1
    _refuse_too_many(count, "a higher rate or fewer frames a second")
    part = step / PARTS
    lead = min(_LEAD * PARTS, math.floor((start - _first(source)) / part)) if part > 0.0 else 0
    after = np.arange(-lead, (count - 1) * PARTS + 1)
    return Instants(np.asarray(start + part * after), range(lead, len(after), PARTS), rate)


def _impacts(source: Source, selection: Selection) -> Instants:
    """Return the middle of each impact in a window, and instants between."""
    first, last = sampling.window(source, selection)
    begin, end = sampling.time_of(source, first), sampling.time_of(source, last - 1)
    pairs = scene_facts.chosen_pairs(source, selection)
    rows = source.impacts()
    rows = rows[np.isin(rows["joint"], [list(source.joints).index(pair) for pair in pairs])]
    middles = (rows["onset"] + rows["release"]) / 2.0  # NaN of a contact that has not ended
    times = np.unique(middles[(middles >= begin) & (middles <= end)])
    if not len(times):
        raise NotDrawable("There are no impacts in this window of time; widen it.", "start")
    _refuse_too_many(len(times), "or one joint")
    count = (len(times) - 1) * PARTS + 1
    between = np.interp(np.arange(count) / PARTS, np.arange(len(times)), times)
    return Instants(between, range(0, count, PARTS), 0.0)


def _refuse_too_many(count: int, otherwise: str) -> None:
    if count > MOST_FRAMES:
        sentence = f"The film would have {count} frames, and {MOST_FRAMES} are the most"
        raise NotDrawable(f"{sentence}: choose a shorter window, {otherwise}.", "stop")


def _ends(source: Source, selection: Selection) -> tuple[float, float]:
    """Return where a film begins and ends, within what is known [s]."""
    first, last = sampling.window(source, selection)
    begin, end = sampling.time_of(source, first), sampling.time_of(source, last - 1)
    if between_samples.knows(source):
        begin, end = between_samples.ends(source, selection)
    turn = _turn(source)
    return begin, end if selection.stop is not None or turn is None else min(end, begin + turn)


def _turn(source: Source) -> float | None:
    """Return the time in which the slowest driver turns once [s]; None where nothing turns."""
    drivers = (scene_facts.scene(source).get("drivers") or {}).values()
    speeds = [abs(driver.get("speed") or 0.0) for driver in drivers]
    return max((2.0 * math.pi / speed for speed in speeds if speed > 0.0), default=None)


def _first(source: Source) -> float:
    return 0.0 if between_samples.knows(source) else sampling.time_of(source, 0)
