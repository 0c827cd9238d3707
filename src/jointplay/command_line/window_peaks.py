"""Peaks of a window of time: of the trajectory where it is known, else of the samples."""

import math
from typing import TYPE_CHECKING, Literal

from jointplay.command_line.exits import Stopped
from jointplay.command_line.peaks import Row, peak_rows

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.client.window import Window
    from jointplay.records.run import Floats

Side = Literal["minimum", "maximum"]


def peaks_inside(
    job: "Job", names: list[str], start: float | None, stop: float | None, spans: int
) -> dict[str, Row]:
    """Return the peaks of a window by channel; `spans` : of a long one, into which it is cut."""
    from jointplay.client import Peak, Refused

    try:
        found = job.results.peaks(start, stop)
    except Refused:
        window = job.window(names, start, stop, points=spans)
        if not len(window.time):
            raise Stopped(f"{job.id} has nothing in this window of time; widen it.") from None
        found = {}
        for name, one in window.channels.items():
            low, high = (_extreme(job, window, name, side) for side in ("minimum", "maximum"))
            found[name] = Peak(*low, *high, one.unit)
    return {row["channel"]: row for row in peak_rows(found)}


def _extreme(job: "Job", window: "Window", name: str, side: Side) -> tuple[float, float]:
    """Return an extreme of a channel and its time [s]; both are NaN where nothing is known.

    Where spans have taken the place of samples, the time is that of the sample in the span.
    """
    at = _place(window[name], side)
    if at is None:
        return math.nan, math.nan
    value, time = float(window[name][at]), float(window.time[at])
    if not window.exact:
        first, last = window.time[at - at % 2], window.time[at - at % 2 + 1]
        inside = job.window([name], float(first), float(last))
        at = _place(inside[name], side)
        time = time if at is None else float(inside.time[at])
    return value, time


def _place(values: "Floats", side: Side) -> int | None:
    """Return where the extreme of what is known is; None where nothing is."""
    import numpy as np

    if np.isnan(values).all():
        return None
    return int(np.nanargmin(values) if side == "minimum" else np.nanargmax(values))
