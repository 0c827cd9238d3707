"""Curves of a run whose trajectory can be read between its samples; else there are none."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from jointplay.figures.kind import Selection
from jointplay.records.arrays import Floats
from jointplay.records.run import Columns, Source
from jointplay.records.works import WORKS

SPANS: Final = 1000
"""Spans of a curve over time, each drawn through its lowest and its highest value."""


def knows(source: Source) -> bool:
    """Tell whether a run can be read between its samples at all."""
    return source.trajectory is not None


def covers(source: Source, time: float) -> bool:
    """Tell, from what is stored alone, whether every instant up to a time [s] can be read."""
    return source.trajectory is not None and time <= source.trajectory.covered


def curve(source: Source, name: str, selection: Selection) -> tuple[Floats, Floats] | None:
    """Give (k,) times [s] and values of a channel, through every extreme at its place."""
    trajectory, (start, stop) = source.trajectory, ends(source, selection)
    if trajectory is None or not start < stop:
        return None
    found = trajectory.extremes([name], trajectory.edges(start, stop, SPANS))
    if found.values is None:
        return None
    rows = found.values[:, 0]
    time = np.concatenate([rows[:, 1], rows[:, 3]])
    values = np.concatenate([rows[:, 0], rows[:, 2]])
    outer = trajectory.values([name], np.array([start, stop]))
    if outer.values is not None:
        time = np.concatenate([[start], time, [stop]])
        values = np.concatenate([outer.values[:1, 0], values, outer.values[1:, 0]])
    order = np.argsort(time, kind="stable")
    return time[order], values[order]


def path(source: Source, names: Sequence[str], selection: Selection, most: int) -> Columns | None:
    """Give times [s] and values of channels, so close together that a path looks as it is."""
    trajectory, (start, stop) = source.trajectory, ends(source, selection)
    if trajectory is None or not start < stop:
        return None
    times = trajectory.instants(start, stop, most)
    return None if times is None else at(source, names, times)


def at(source: Source, names: Sequence[str], times: Floats) -> Columns | None:
    """Give times [s] and values of channels there; None if they are not known."""
    if source.trajectory is None:
        return None
    found = source.trajectory.values(names, times)
    if found.values is None:
        return None
    return times, dict(zip(names, found.values.T, strict=True))


def works(source: Source, times: Floats) -> dict[str, Floats] | None:
    """Give works [J] since the first of some times [s], by name of the ledger; None: not known."""
    if source.trajectory is None or not times[0] < times[-1]:
        return None
    found = source.trajectory.works(float(times[0]), float(times[-1]))
    if found.values is None:
        return None
    moments, *columns = found.values.T
    curves = (np.interp(times, moments, column) for column in columns)
    return dict(zip(WORKS, curves, strict=True))


def ends(source: Source, selection: Selection) -> tuple[float, float]:
    """Give where a window begins and ends [s], within the run."""
    reached = source.trajectory.reached if source.trajectory is not None else 0.0
    start = 0.0 if selection.start is None else max(selection.start, 0.0)
    return start, reached if selection.stop is None else min(selection.stop, reached)
