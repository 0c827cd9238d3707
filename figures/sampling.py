"""Values for the screen: as many as a figure can show, whatever the length of the history."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from jointplay.figures.kind import NotDrawable, Selection
from jointplay.records.arrays import Floats
from jointplay.records.run import Columns, Source

MOST_SAMPLES: Final = 4000
"""Above, a curve over time is drawn through the extremes of equal spans: four a pixel."""
MOST_PATH_SAMPLES: Final = 50_000
"""Above, a curve in a plane shows its end only; it has no order that extremes would keep."""
NO_SAMPLES: Final = "There are no samples in this window of time; widen it."


def window(source: Source, selection: Selection) -> tuple[int, int]:
    """Find the samples to draw.

    Raises
    ------
    NotDrawable
        There are none.
    """
    first, last = source.between(selection.start, selection.stop)
    if last <= first:
        raise NotDrawable(NO_SAMPLES, "start")
    return first, last


def over_time(source: Source, name: str, selection: Selection) -> tuple[Floats, Floats]:
    """Give (k,) times [s] and values of one channel, every extreme among them."""
    first, last = window(source, selection)
    span = max(2 * (last - first) // MOST_SAMPLES, 1)
    parts = [
        _extremes(time, columns[name], span) for time, columns in source.blocks([name], first, last)
    ]
    return np.concatenate([part[0] for part in parts]), np.concatenate([p[1] for p in parts])


def in_a_plane(source: Source, names: tuple[str, ...], selection: Selection) -> Columns:
    """Give times [s] and values of channels, at the end of the window if it is long."""
    first, last = window(source, selection)
    return joined(source, names, max(first, last - MOST_PATH_SAMPLES), last)


def joined(source: Source, names: Sequence[str], first: int, last: int) -> Columns:
    """Give times [s] and values of channels at samples `first` to `last` - 1, in one piece."""
    parts = list(source.blocks(names, first, last))
    time = np.concatenate([time for time, _ in parts])
    return time, {name: np.concatenate([columns[name] for _, columns in parts]) for name in names}


def beginning(source: Source, time: Floats, selection: Selection) -> str:
    """Say from when on a curve in a plane is drawn, if not from the beginning of the window."""
    first, _ = window(source, selection)
    ((begin, _),) = source.blocks([], first, first + 1)
    return f" from {time[0]:.4g} s" if time[0] > begin[0] else ""


def _extremes(time: Floats, values: Floats, span: int) -> tuple[Floats, Floats]:
    """Keep the smallest and the largest value of every `span` samples, in order of time."""
    if span <= 2:
        return time, values
    starts = np.arange(0, len(values), span)
    chosen = [
        start + extreme(values[start : start + span])
        for start in starts
        for extreme in (np.argmin, np.argmax)
    ]
    order = np.unique(chosen)
    return time[order], values[order]
