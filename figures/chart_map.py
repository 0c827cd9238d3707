"""The map of a chart: its cells and axes, in a panel that may show more."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.attractors import attractors_of, colour_of_attractor
from jointplay.records.channel import Channel
from jointplay.records.extremes import extreme, extremes
from jointplay.records.inherited import inheriting
from jointplay.records.motion import (
    ATTRACTOR,
    LABELS,
    MOTION,
    WAITING,
    Labels,
    colour_of,
    motions,
    name_of,
)
from jointplay.records.point import has_ended
from jointplay.records.pyramid import averaged, filled_in, in_majority
from jointplay.records.study import StudySource

KINDS = ("chart", "basins")
_MOST_NAMED = 12
"""Labels in the legend: those of most points."""
_MOST_CELLS = 1000
"""Along each axis; more would not be seen."""
UNITS = {"lyapunov": ("1/s", "largest Lyapunov exponent"), "period": ("1", "period in sections")}
_SHARE = 2.0
"""Per cent of the values beyond each end of the colours."""


class ChartMap:
    """A quantity of a chart, or of basins, over both axes."""

    def __init__(self, source: StudySource, name: str) -> None:
        self._source, self._name = source, name
        self.up, self.across = (
            ParameterAxis(source, column, slice(0, source.points)) for column in (0, 1)
        )
        self._labelled = _labelled(source, name)
        self.legend = _legend(self._labelled)
        """Marker and colour by label."""
        self.caption = " ".join(filter(None, (_waiting(source), _inherited(source))))

    def draw(self, figure: page.Figure, axes: page.Axes) -> None:
        """Draw the cells, and give the panel their axes."""
        source, name, across, up = self._source, self._name, self.across, self.up
        cells = tuple(np.searchsorted(axis.values, axis.shown) for axis in (up, across))
        shape = len(up.values), len(across.values)
        stride = -(-max(shape) // _MOST_CELLS)
        axes.set_facecolor(colours.UNKNOWN)
        edges = _edges(across, stride), _edges(up, stride)
        known = np.zeros(shape, np.bool_)
        known[cells] = has_ended(source.status)
        if name in LABELS:
            table = np.full(shape, WAITING, np.uint8)
            table[cells] = self._labelled.labels
            filled = in_majority(filled_in(table, known), stride)
            _paint_labels(axes, edges, filled, self._labelled.colour_of)
        else:
            values = np.full(shape, np.nan)
            values[cells] = _values(source, name)
            filled_values = averaged(filled_in(values, known), stride)
            _paint_values(figure, axes, edges, filled_values, _described(source, name))
        if across.logarithmic:
            axes.set_xscale("log")  # which numbers the axis anew
        if up.logarithmic:
            axes.set_yscale("log")
        for axis, parameter in ((axes.xaxis, across), (axes.yaxis, up)):
            parameter.ticks(axis, 5)
        axes.tick_params(which="both", direction="out", top=False, right=False)
        axes.set_xlabel(across.label)
        axes.set_ylabel(up.label)


def offered(source: StudySource) -> list[str]:
    """Return the quantities of a chart, the first one first."""
    told = [] if source.verdicts is None else [MOTION]
    motion = [ATTRACTOR, *told] if told and "states" in source.attributes else told
    numbers = [name for name in (*source.indicators, *source.statistics) if name != "verdict"]
    return [*motion, *numbers, *extremes(source)]


def _waiting(source: StudySource) -> str:
    """Return how many points of a chart have not ended, as a sentence; empty: none."""
    ended = int(has_ended(source.status).sum())
    if ended == source.points:
        return ""
    return (
        f"{ended} of {source.points} points are computed; the others look as the nearest of these."
    )


def _inherited(source: StudySource) -> str:
    """Return how many points of a chart were not computed, as a sentence; empty: all were."""
    count = inheriting(source)
    if not count:
        return ""
    share = count / has_ended(source.status).sum()
    return (
        f"{share:.1%} of the points were not computed: the corners of their cell are alike, and"
        " they have the results of one of them."
    )


@dataclass(frozen=True)
class _Labelled:
    """Labels of the points, and their names and colours."""

    labels: Labels
    name_of: Callable[[int], str] = name_of
    colour_of: Callable[[int], str] = colour_of


def _labelled(source: StudySource, name: str) -> _Labelled:
    """Return the labels of a quantity; none of one of numbers."""
    if name == ATTRACTOR:
        found = attractors_of(source)
        return _Labelled(found.labels, found.name_of, colour_of_attractor)
    if name != MOTION:
        return _Labelled(np.zeros(0, np.uint8))
    period = source.indicators.get("period", np.full(source.points, np.nan))
    verdict = source.indicators["verdict"]
    return _Labelled(motions(source.status, verdict, period, source.verdict_names))


def _legend(shown: _Labelled) -> dict[str, tuple[str, str]]:
    """Return marker and colour of the labels that most points have."""
    counts = np.bincount(shown.labels, minlength=256)
    counts[WAITING] = 0
    often = np.argsort(-counts, kind="stable")[:_MOST_NAMED]
    codes = [int(code) for code in sorted(often) if counts[code]]
    return {shown.name_of(code): ("s", shown.colour_of(code)) for code in codes}


def _edges(axis: ParameterAxis, stride: int) -> Floats:
    """Return the edges of cells of several points."""
    inner = axis.edges[:-1:stride]
    return np.append(inner, axis.edges[-1])


def _paint_labels(
    axes: page.Axes,
    edges: tuple[Floats, Floats],
    table: Labels,
    colour_of: Callable[[int], str],
) -> None:
    from matplotlib.colors import BoundaryNorm, ListedColormap

    codes = np.unique(table)
    codes = codes[codes != WAITING]
    if not len(codes):
        return
    cells = np.ma.masked_array(np.searchsorted(codes, table), mask=table == WAITING)
    shades = ListedColormap([colour_of(int(code)) for code in codes])
    norm = BoundaryNorm(np.arange(len(codes) + 1) - 0.5, len(codes))
    axes.pcolormesh(*edges, cells, cmap=shades, norm=norm, rasterized=True)


def _paint_values(
    figure: page.Figure,
    axes: page.Axes,
    edges: tuple[Floats, Floats],
    table: Floats,
    described: Channel,
) -> None:
    from matplotlib.ticker import MaxNLocator

    shown = scale(described.unit, table[np.isfinite(table)])
    values = table / shown.factor
    known = values[np.isfinite(values)]
    low, high = np.percentile(known, (_SHARE, 100.0 - _SHARE)) if len(known) else (0.0, 1.0)
    ends = {(False, False): "neither", (True, False): "min", (False, True): "max"}
    beyond = bool((known < low).any()), bool((known > high).any())
    drawn = axes.pcolormesh(
        *edges,
        np.ma.masked_invalid(values),
        cmap=colours.MAP,
        vmin=low,
        vmax=high,
        rasterized=True,
    )
    bar = figure.colorbar(
        drawn, ax=axes, location="top", aspect=25.0, extend=ends.get(beyond, "both")
    )
    if len(known) and known.min() == known.max():
        bar.set_ticks([low], labels=[f"{low:.4g} everywhere"])
    elif (known == np.round(known)).all():  # such as periods, which are counted
        bar.locator = MaxNLocator("auto", integer=True)
    bar.ax.set_gid(page.WITHOUT_SCALE)
    bar.set_label(shown.label(described.long_name))


def _values(source: StudySource, name: str) -> Floats:
    """Return (points,) numbers of a quantity."""
    if name in extremes(source):
        return extreme(source, name)
    return {**source.statistics, **source.indicators}[name]


def _described(source: StudySource, name: str) -> Channel:
    if found := extremes(source).get(name):
        return found
    meanings = source.attributes.get("meanings", {})
    unit, long_name = meanings.get(name) or UNITS.get(name, ("1", name.replace("_", " ")))
    return Channel(name, unit, long_name)
