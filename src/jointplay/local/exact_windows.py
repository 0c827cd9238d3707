"""Windows of a run in a folder, computed from its steps in this process."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from jointplay.client.window import ChannelSeries, Window
from jointplay.records.peak import Peak
from jointplay.records.run import Floats
from jointplay.records.window_query import WindowQuery
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.trajectory import Trajectory

MOST_VALUES = 50_000_000
"""Numbers of one window: 400 MB."""


def trajectory_of(reader: ResultReader) -> Trajectory:
    """Return a run's trajectory; the solver is loaded by the first question."""

    def ask(question: Any) -> Any:
        from jointplay.worker.windows.evaluate import answer

        return answer(question)

    return Trajectory(reader, ask)


def exact_window(
    reader: ResultReader,
    names: Sequence[str],
    query: WindowQuery,
) -> Window | str:
    """Return values at instants, or extremes of spans, of channels; or why there are none.

    Raises
    ------
    NoSuchWindow
        Of instants: the run has nothing of the window. There are no spans then.
    """
    trajectory, step = trajectory_of(reader), query.step
    if step is not None:
        if query.points is not None or not step > 0.0 or not np.isfinite(step):
            return "Give either a positive step in s, or points."
        ends = trajectory.ends(query.start, query.stop)
        return _values(reader, trajectory, names, *ends, step)
    edges = trajectory.edges(query.start, query.stop, query.points or 1)
    found = trajectory.extremes(names, edges)
    if found.values is None:
        return found.refused
    time = np.column_stack([edges[:-1], edges[1:]]).ravel()
    columns = {name: found.values[:, c, ::2].ravel() for c, name in enumerate(names)}
    return window_of(
        reader,
        time,
        columns,
        exact=False,
        between_samples=True,
        note=found.note,
        resolution=found.resolution,
    )


def _values(
    reader: ResultReader,
    trajectory: Trajectory,
    names: Sequence[str],
    first: float,
    last: float,
    step: float,
) -> Window | str:
    count = max(np.floor((last - first) / step * (1.0 + 1e-12)), 0.0) + 1.0
    if count * (len(names) + 1) > MOST_VALUES:
        return f"{count:.3g} instants are too many; ask for a longer step or a shorter window."
    times = np.minimum(first + step * np.arange(int(count)), last)
    found = trajectory.values(names, times)
    if found.values is None:
        return found.refused
    columns = dict(zip(names, found.values.T, strict=True))
    return window_of(reader, times, columns, note=found.note, resolution=found.resolution)


def exact_peaks(
    reader: ResultReader, start: float | None, stop: float | None
) -> dict[str, Peak] | str:
    """Return the extremes of all channels in a window; or why there are none.

    Raises
    ------
    NoSuchWindow
        The run has nothing of the window.
    """
    trajectory = trajectory_of(reader)
    names = [channel.name for channel in reader.channels]
    found = trajectory.extremes(names, np.array(trajectory.ends(start, stop)))
    if found.values is None:
        return found.refused
    rows = found.values[0].tolist()
    return {name: Peak(*row) for name, row in zip(names, rows, strict=True)}


def window_of(
    reader: ResultReader, time: Floats, columns: Mapping[str, Floats], **more: Any
) -> Window:
    """Return columns over times as a window, with what the run says of its channels."""
    described = {channel.name: channel for channel in reader.channels}
    series = {
        name: ChannelSeries(described[name].unit, described[name].long_name, values)
        for name, values in columns.items()
    }
    return Window(np.asarray(time, np.float64), series, reader.complete, **more)
