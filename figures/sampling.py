"""Values for the screen: as many as a figure can show, smooth between samples where they may be."""

from collections.abc import Sequence
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from jointplay.figures import between_samples
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.records.arrays import Flags, Floats
from jointplay.records.run import Columns, Source

MOST_SAMPLES: Final = 4000
"""Above, a curve over time is drawn through the extremes of equal spans: four a pixel."""
MOST_PATH_SAMPLES: Final = 50_000
"""Above, a curve in a plane shows its end only; it has no order that extremes would keep."""
TRAJECTORY: Final = "trajectory"
SAMPLES: Final = "samples"
"""Names of curves in legends."""
NO_SAMPLES: Final = "There are no samples in this window of time; widen it."
_MOST_ARCS: Final = 12
"""Pieces of an arc: no corner is seen between them."""
_WIDEST: Final = 0.5
"""An arc that leaves its chord by more of its length is no motion that the samples resolve."""


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
    """Give (k,) times [s] and values of one channel, every extreme among them.

    Extremes of the trajectory where it is known between samples, else those of the samples.
    """
    time, values, _ = named_over_time(source, name, selection)
    return time, values


def named_over_time(
    source: Source, name: str, selection: Selection
) -> tuple[Floats, Floats, Literal["trajectory", "samples"]]:
    """Give what `over_time` does, and what the curve is made of."""
    first, last = window(source, selection)
    exact = between_samples.curve(source, name, selection)
    if exact is not None:
        return *exact, TRAJECTORY
    span = max(2 * (last - first) // MOST_SAMPLES, 1)
    parts = [
        extremes(time, columns[name], span) for time, columns in source.blocks([name], first, last)
    ]
    joined = np.concatenate([part[0] for part in parts]), np.concatenate([p[1] for p in parts])
    return *joined, SAMPLES


def called(source: Source, selection: Selection, time: Floats) -> str:
    """Say what a path is made of: as many instants as samples are samples."""
    first, last = window(source, selection)
    known = between_samples.knows(source) and len(time) != min(last - first, MOST_PATH_SAMPLES)
    return TRAJECTORY if known else SAMPLES


def in_a_plane(source: Source, names: tuple[str, ...], selection: Selection) -> Columns:
    """Give times [s] and values of channels, at the end of the window if it is long."""
    first, last = window(source, selection)
    exact = between_samples.path(source, names, selection, MOST_PATH_SAMPLES)
    if exact is not None:
        return exact
    return joined(source, names, max(first, last - MOST_PATH_SAMPLES), last)


def whole(source: Source, names: Sequence[str], selection: Selection) -> Columns:
    """Give times [s] and values of all of a window: as close as steps where these are kept."""
    first, last = window(source, selection)
    exact = between_samples.path(source, names, selection, MOST_PATH_SAMPLES)
    return exact if exact is not None else joined(source, names, first, last)


def joined(source: Source, names: Sequence[str], first: int, last: int) -> Columns:
    """Give times [s] and values of channels at samples `first` to `last` - 1, in one piece."""
    parts = list(source.blocks(names, first, last))
    time = np.concatenate([time for time, _ in parts])
    return time, {name: np.concatenate([columns[name] for _, columns in parts]) for name in names}


def interpolated(moments: Floats, time: Floats, values: Floats, rates: Floats | None) -> Floats:
    """Give (m,) values at moments [s] within the samples: of their cubic, or straight between."""
    if rates is None or len(time) < 2:
        return np.interp(moments, time, values)
    at = np.clip(np.searchsorted(time, moments, side="right") - 1, 0, len(time) - 2)
    step = time[at + 1] - time[at]
    part = (moments - time[at]) / step
    rise = values[at + 1] - values[at]
    begin, end = rates[at] * step, rates[at + 1] * step
    cubic = (3.0 * rise - 2.0 * begin - end) * part**2 + (begin + end - 2.0 * rise) * part**3
    return np.asarray(values[at] + begin * part + cubic)


def beginning(source: Source, time: Floats, selection: Selection) -> str:
    """Say from when on a curve in a plane is drawn, if not from the beginning of the window."""
    first, _ = window(source, selection)
    return f" from {time[0]:.4g} s" if time[0] > time_of(source, first) else ""


def time_of(source: Source, sample: int) -> float:
    """Give the time [s] of one sample."""
    ((time, _),) = source.blocks([], sample, sample + 1)
    return float(time[0])


def impacts_of(source: Source, joint: str) -> NDArray[Any]:
    """Give the contacts of one joint, of dtype `records.impact.IMPACT`."""
    rows = source.impacts()
    return np.asarray(rows[rows["joint"] == list(source.joints).index(joint)])


def extremes(time: Floats, values: Floats, span: int) -> tuple[Floats, Floats]:
    """Keep the smallest and the largest value of every `span` samples, in order of time.

    Where a value is not known (NaN) the first one of the span is kept as well: a gap stays one.
    """
    if span <= 2:
        return time, values
    unknown = np.isnan(values)
    lower, upper = np.where(unknown, np.inf, values), np.where(unknown, -np.inf, values)
    chosen: list[int] = []
    for start in range(0, len(values), span):
        inside = slice(start, start + span)
        chosen += [start + int(lower[inside].argmin()), start + int(upper[inside].argmax())]
        if unknown[inside].any():
            chosen.append(start + int(unknown[inside].argmax()))
    order = np.unique(chosen)
    return time[order], values[order]


def stored_rates(source: Source, positions: tuple[str, ...]) -> tuple[str, ...]:
    """Name the rates of positions if all of them were stored, else nothing."""
    known = {channel.name for channel in source.channels}
    rates = tuple(_rate_of(name) for name in positions)
    return rates if known.issuperset(rates) else ()


def path(source: Source, joint: str, names: tuple[str, ...], selection: Selection) -> Columns:
    """Give times [s] and values of a joint's eccentricities, dense enough to look smooth.

    Between two samples a position follows the cubic of both positions and rates (Hermite), which
    is exact in free flight under constant acceleration, and a rate its derivative. Where a contact
    begins or ends in between, or the arc would be wild, the samples are joined straight.

    Parameters
    ----------
    joint
        Its contacts are looked at.
    names
        Of channels; those of positions need their rates among the stored ones.
    """
    exact = between_samples.path(source, names, selection, MOST_PATH_SAMPLES)
    if exact is not None:
        return exact
    positions = tuple(name for name in names if ".eccentricity_rate_" not in name)
    rates = stored_rates(source, positions)
    time, values = in_a_plane(source, tuple(dict.fromkeys((*names, *rates))), selection)
    pieces = min(MOST_PATH_SAMPLES // max(len(time), 1), _MOST_ARCS)
    if not rates or pieces < 2 or len(time) < 2:
        return time, {name: values[name] for name in names}
    smooth = _quiet(source, joint, time)
    for position, rate in zip(positions, rates, strict=True):
        smooth &= _near_chord(time, values[position], values[rate])
    fraction = np.arange(pieces) / pieces
    dense: dict[str, Floats] = {}
    for position, rate in zip(positions, rates, strict=True):
        arcs, slopes = _hermite(time, values[position], values[rate], fraction)
        dense[position] = _joined(arcs, values[position], smooth, fraction)
        dense[rate] = _joined(slopes, values[rate], smooth, fraction)
    moments = time[:-1, None] + np.diff(time)[:, None] * fraction
    return np.append(moments.ravel(), time[-1]), {name: dense[name] for name in names}


def _rate_of(position: str) -> str:
    return position.replace(".eccentricity_", ".eccentricity_rate_")


def _quiet(source: Source, joint: str, time: Floats) -> Flags:
    """Tell of each interval between samples whether no contact begins or ends in it."""
    rows = impacts_of(source, joint)
    quiet = np.ones(len(time) - 1, dtype=bool)
    for events in (rows["onset"], rows["release"]):
        inside = events[(events >= time[0]) & (events < time[-1])]
        quiet[np.searchsorted(time, inside, side="right") - 1] = False
    return quiet


def _near_chord(time: Floats, position: Floats, rate: Floats) -> Flags:
    """Tell of each interval whether its arc stays near its chord."""
    middle, _ = _hermite(time, position, rate, np.array([0.25, 0.75]))
    chord = position[:-1, None] + np.diff(position)[:, None] * np.array([0.25, 0.75])
    reach = np.max(np.abs(rate)) * np.diff(time)
    beyond = np.abs(middle - chord).max(axis=1)
    return np.asarray(beyond <= _WIDEST * np.maximum(np.abs(np.diff(position)), 0.1 * reach))


def _hermite(
    time: Floats, position: Floats, rate: Floats, fraction: Floats
) -> tuple[Floats, Floats]:
    """Give positions and rates at fractions of every interval, (intervals, fractions)."""
    step = np.diff(time)[:, None]
    rise = np.diff(position)[:, None]
    begin, end = rate[:-1, None] * step, rate[1:, None] * step
    square, cube = fraction**2, fraction**3
    arcs = position[:-1, None] + begin * fraction
    arcs = arcs + (3.0 * rise - 2.0 * begin - end) * square + (begin + end - 2.0 * rise) * cube
    slopes = begin + 2.0 * (3.0 * rise - 2.0 * begin - end) * fraction
    slopes = slopes + 3.0 * (begin + end - 2.0 * rise) * square
    return arcs, slopes / step


def _joined(arcs: Floats, samples: Floats, smooth: Flags, fraction: Floats) -> Floats:
    """Take the arcs where the motion is smooth, straight lines elsewhere."""
    straight = samples[:-1, None] + np.diff(samples)[:, None] * fraction
    return np.append(np.where(smooth[:, None], arcs, straight).ravel(), samples[-1])
