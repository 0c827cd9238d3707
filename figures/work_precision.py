"""Work-precision diagram: the error of every method and tolerance over its evaluations."""

import numpy as np

from jointplay.figures import colours, log_axis, page
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.records.arrays import Floats
from jointplay.records.energy_residual import relative_energy_residuals
from jointplay.records.study import StudySource

_PANEL_HEIGHT = 55.0  # mm
_LEGEND_COLUMNS = 3  # names of methods are long
_MOST_RESIDUAL = 0.05
"""Residual of the energy, as a share of the losses, beyond which methods are refused."""


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if "runs" not in source.attributes:
        raise NotDrawable("Work and precision are drawn of an accuracy-study.")
    return ()


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    runs = source.attributes["runs"]
    measured = [i for i, run in enumerate(runs) if not run["reference"]]
    references = len(runs) - len(measured)
    errors = _column(source, "error")
    if not np.isfinite(errors[measured]).any():
        waiting = not np.isfinite(_column(source, "window")[:references]).any()
        raise NotDrawable(
            "No run has been compared with the reference yet."
            if waiting
            else "The references agree at the start alone: no error is known."
        )
    admitted = np.array([run["admitted"] for run in runs])
    cost = _column(source, "evaluations")
    drawn = {"error": errors}
    residual = relative_energy_residuals(source)
    if (residual[measured] > 0.0).any():  # of no losses there is no share
        drawn["energy residual / losses"] = residual
    uncertainty = float(errors[references - 1])
    explained = _explained(bool(uncertainty > 0.0), len(drawn) > 1, bool(admitted[measured].all()))
    height = _PANEL_HEIGHT * len(drawn) + page.caption_height(explained)
    figure, grid = page.panels(len(drawn), 1, height, share_x=True)
    above, last = grid[0][0], grid[-1][0]
    methods = dict.fromkeys(runs[i]["method"] for i in measured)
    for name, (colour, dashes, mark) in zip(methods, colours.COMPARED, strict=False):
        chosen = np.array([i for i in measured if runs[i]["method"] == name])
        for (axes,), values in zip(grid, drawn.values(), strict=True):
            shown = chosen[values[chosen] > 0.0]
            axes.plot(cost[shown], values[shown], color=colour, linestyle=dashes, label=name)
            for inside, each in ((colour, admitted[shown]), ("white", ~admitted[shown])):
                style: page.Style = {
                    "marker": mark,
                    "markerfacecolor": inside,
                    "markeredgewidth": 0.6,
                }
                points = (cost[shown][each], values[shown][each])
                axes.plot(*points, color=colour, linestyle="", **style)
    for (axes,), label in zip(grid, drawn, strict=True):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylabel(label)
        for axis in (axes.xaxis, axes.yaxis):
            log_axis.number(axis)
    if uncertainty > 0.0:
        low = min(above.get_ylim()[0], uncertainty)
        above.axhspan(0.1 * low, uncertainty, color=colours.UNKNOWN, linewidth=0.0)
        above.set_ylim(bottom=low)
    if last is not above:
        last.axhline(_MOST_RESIDUAL, color=colours.AUXILIARY, linewidth=0.6, linestyle="--")
    last.set_xlabel("evaluations of the equations of motion")
    page.caption(figure, explained)
    figure.align_ylabels()
    page.legend(figure, above, ncols=_LEGEND_COLUMNS)
    return figure


def _explained(band: bool, threshold: bool, all_admitted: bool) -> str:
    """Say what open marks, the band and the dashed line are, where they are drawn."""
    parts = {
        "Open marks: a job may not ask for this tolerance.": not all_admitted,
        "Grey band: the reference itself is not known better.": band,
        "Dashed line: methods that lose more energy are refused.": threshold,
    }
    return " ".join(sentence for sentence, drawn in parts.items() if drawn)


def _column(source: StudySource, name: str) -> Floats:
    """Give (points,) of a number; NaN where no run has it yet."""
    return source.statistics.get(name, np.full(source.points, np.nan))


WORK_PRECISION = StudyFigure(
    name="work-precision",
    title="Error, and residual of the energy, of every method and tolerance over its evaluations",
    uses=(),
    channels=_channels,
    draw=_draw,
)
