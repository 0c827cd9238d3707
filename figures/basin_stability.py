"""Basin stability: how many starts end on each attractor, over a parameter or in all."""

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.records.attractor_table import SharesAlong, shares_along
from jointplay.records.attractors import Attractors, attractors_of, colour_of_attractor
from jointplay.records.study import StudySource

_HEIGHT = 55.0  # mm
_ROW, _LEAST = 6.0, 20.0
_MOST = 12
"""Attractors that are drawn: those of the largest shares."""
_CAPTION = "Bars: standard errors of shares."


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind != "basin-stability":
        raise NotDrawable("Shares of basins are drawn of a job of kind basin-stability.")
    return ()


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    found = attractors_of(source)
    if not found.found:
        raise NotDrawable("No start has ended yet.")
    over = shares_along(source, found)
    if over is None or len(over.values) < 2:
        return _in_all(found)
    return _over(source, found, over)


def _most(found: Attractors) -> list[int]:
    """Return the positions of attractors that are drawn, in their own order."""
    often = sorted(range(len(found.found)), key=lambda k: -found.found[k].points)
    return sorted(often[:_MOST])


def _in_all(found: Attractors) -> page.Figure:
    shown = [found.found[k] for k in _most(found)]
    height = max(_ROW * len(shown), _LEAST) + page.AXIS_HEIGHT + page.caption_height(_CAPTION)
    figure, ((axes,),) = page.panels(1, 1, height)
    rows = range(len(shown))
    axes.barh(
        rows,
        [one.share for one in shown],
        0.7,
        xerr=[one.error for one in shown],
        color=[colour_of_attractor(one.code) for one in shown],
        error_kw={"elinewidth": 0.6, "capsize": 1.2},
    )
    axes.set_yticks(rows, [one.name for one in shown])
    axes.set_ylim(len(shown) - 0.5, -0.5)
    axes.tick_params(axis="y", which="both", length=0.0)
    axes.set_xlim(0.0, 1.0)
    axes.set_xlabel("share of starts")
    page.caption(figure, _CAPTION)
    return figure


def _over(source: StudySource, found: Attractors, over: SharesAlong) -> page.Figure:
    axis = ParameterAxis(source, over.column, slice(0, source.points))
    shown = _most(found)
    entries = {found.found[k].name: ("s", colour_of_attractor(found.found[k].code)) for k in shown}
    height = _HEIGHT + page.AXIS_HEIGHT + page.caption_height(_CAPTION)
    height += page.legend_rows(entries) * page.LEGEND_HEIGHT
    figure, ((axes,),) = page.panels(1, 1, height)
    axes.set_facecolor(colours.UNKNOWN)
    shares = np.nan_to_num(over.shares)
    below = np.zeros(len(over.values))
    for k in shown:
        axes.bar(
            axis.edges[:-1],
            shares[k],
            np.diff(axis.edges),
            bottom=below,
            align="edge",
            color=colour_of_attractor(found.found[k].code),
            linewidth=0.0,
        )
        below = below + shares[k]
        middle = (shares[k] > 0.0) & (below < 1.0 - 1e-9)
        axes.errorbar(
            axis.values[middle],
            below[middle],
            yerr=over.errors[k][middle],
            fmt="none",
            ecolor=colours.GEOMETRY,
            elinewidth=0.5,
            capsize=1.0,
        )
    if axis.logarithmic:
        axes.set_xscale("log")
    axes.set_xlim(float(axis.edges[0]), float(axis.edges[-1]))
    axis.ticks(axes.xaxis, 6)
    axes.set_ylim(0.0, 1.0)
    axes.set_xlabel(axis.label)
    axes.set_ylabel("share of starts")
    page.caption(figure, _CAPTION)
    page.legend_of_marks(figure, entries)
    return figure


BASIN_STABILITY = StudyFigure(
    name="basin-stability",
    title="How many starts end on each attractor",
    uses=(),
    channels=_channels,
    draw=_draw,
)
"""Shares of starts."""
