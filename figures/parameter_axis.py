"""The axis of a study's parameter: scale, what is not finished, what failed."""

from collections.abc import Mapping

import numpy as np

from jointplay.figures import colours, log_axis, page
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

_LOGARITHMIC = 20.0
"""Values of a list that span such a ratio, spaced more evenly by ratio, have a logarithmic axis."""
_LEAST_RATIO = 1.5
"""So have values that span this one if their ratios are all the same."""
_EVEN = 1e-6
"""Largest relative deviation of steps that are the same."""


class ParameterAxis:
    """Values of a study's parameter, over some of its points, along an axis."""

    def __init__(self, source: StudySource, column: int, points: slice) -> None:
        values = source.values[points, column]
        parameter = source.parameters[column]
        chosen = scale(parameter.unit, values)
        self.label = chosen.label(parameter.name)
        self.name, self.factor = parameter.name, chosen.factor
        self.shown = values / chosen.factor
        """(points,) values as they are shown."""
        self.status = source.status[points]
        """(points,) codes of the points."""
        self.logarithmic = _logarithmic(source, parameter.name, np.unique(values))
        self.values = np.unique(self.shown)
        """(n,) the different values, ascending."""
        spaced = np.log(self.values) if self.logarithmic else self.values
        self.edges = np.exp(_edges(spaced)) if self.logarithmic else _edges(spaced)
        """(n + 1,) edges half way between them."""

    def dress(self, axes: page.Axes, intervals: int = 8) -> None:
        """Give the axes of a panel their ends, shade unfinished ranges and mark failed values."""
        if self.logarithmic:
            axes.set_xscale("log")
        axes.set_xlim(float(self.edges[0]), float(self.edges[-1]))
        self.ticks(axes.xaxis, intervals)
        for low, high in self.unfinished():
            axes.axvspan(low, high, color=colours.UNKNOWN, linewidth=0.0, zorder=0.5)
        failed = self.shown[self.status == PointStatus.failed]
        if len(failed):
            axes.plot(
                failed,
                np.zeros(len(failed)),
                "x",
                transform=axes.get_xaxis_transform(),
                clip_on=False,
                color=colours.GEOMETRY,
                markersize=3.0,
                markeredgewidth=0.7,
                zorder=3.0,
            )

    def ticks(self, axis: page.Axis, intervals: int, *, own: bool = False) -> None:
        """Give an axis of this one's scale, whose ends are known, numbers that stand apart.

        They are the parameter's own values where there are few of them, or with `own` some of them.
        """
        from matplotlib.ticker import FixedLocator, MaxNLocator, NullLocator, StrMethodFormatter

        if own or len(self.values) <= intervals:
            apart = -(-len(self.values) // intervals)
            axis.set_major_locator(FixedLocator(self.values[::apart].tolist()))
            axis.set_major_formatter(StrMethodFormatter("{x:.3g}"))
            axis.set_minor_locator(NullLocator())
        elif self.logarithmic:
            log_axis.number(axis, intervals)
        else:
            axis.set_major_locator(MaxNLocator(intervals, steps=[1, 2, 2.5, 5, 10]))

    def legend(self) -> dict[str, tuple[str, str]]:
        """Explain the signs that `dress` draws: marker and colour by label."""
        entries = {}
        if (self.status == PointStatus.failed).any():
            entries["failed"] = ("x", colours.GEOMETRY)
        if self.unfinished():
            entries["not finished"] = ("s", colours.UNKNOWN)
        return entries

    def unfinished(self) -> list[tuple[float, float]]:
        """Give the ranges in which values wait or are being computed."""
        open_points = np.isin(self.status, (PointStatus.waiting, PointStatus.running))
        is_open = np.isin(self.values, self.shown[open_points])
        changes = np.flatnonzero(np.diff(is_open, prepend=False, append=False))
        return [
            (float(self.edges[begin]), float(self.edges[end]))
            for begin, end in changes.reshape(-1, 2)
        ]


def _edges(values: Floats) -> Floats:
    """Give n + 1 edges half way between n ascending values."""
    if len(values) == 1:
        reach = 0.5 * abs(float(values[0])) or 0.5
        return np.array([values[0] - reach, values[0] + reach])
    middle = (values[1:] + values[:-1]) / 2.0
    first, last = 2.0 * values[0] - middle[0], 2.0 * values[-1] - middle[-1]
    return np.concatenate([[first], middle, [last]])


def _logarithmic(source: StudySource, name: str, values: Floats) -> bool:
    """Tell whether a parameter's ascending values were asked for, or are, spaced by ratio."""
    if len(values) < 3 or values[0] <= 0.0:
        return False
    job = source.attributes["job"]
    asked = job.get("grid", {}).get(name)
    if asked is None and job.get("parameter") == name:
        asked = job.get("values")
    for axis in (job.get("along"), job.get("by")):
        if isinstance(axis, Mapping) and axis.get("parameter") == name:
            asked = axis.get("values")
    if isinstance(asked, Mapping):
        return bool(asked.get("spacing") == "log")
    steps, ratios = _unevenness(np.diff(values)), _unevenness(np.diff(np.log(values)))
    if ratios < _EVEN < steps and values[-1] >= _LEAST_RATIO * values[0]:
        return True
    return bool(values[-1] >= _LOGARITHMIC * values[0] and ratios < steps)


def _unevenness(steps: Floats) -> float:
    """Give the standard deviation of steps by their mean."""
    return float(np.std(steps) / np.mean(steps))
