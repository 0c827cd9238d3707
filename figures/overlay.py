"""The same channels of several runs over one another."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from textwrap import fill

from jointplay.figures import colours, page, saving
from jointplay.figures.adjustment import drawn
from jointplay.figures.options import Options
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.figure_form import Form

_PANEL_HEIGHT = 30.0  # mm
MOST_CURVES = len(colours.COMPARED)
_ROW, _LINE = 58, 8
"""Letters in a row of the legend, and how many the line before a label takes the room of."""


@dataclass(frozen=True)
class Curve:
    """One run's channel over time [s], in a unit."""

    label: str
    unit: str
    time: Floats
    values: Floats


def draw_overlay(panels: Mapping[str, Sequence[Curve]], form: Form, options: Options) -> bytes:
    """Return a figure with one panel for each channel, in it a curve for each run.

    Parameters
    ----------
    panels
        By channel, curves with the same labels in the same order; at most `MOST_CURVES`.
    form
        Of the file.
    options
        Of its page.
    """
    with page.style(options.font, options.font_size):
        return saving.save(drawn(lambda: _draw(panels), options), form)


def _draw(panels: Mapping[str, Sequence[Curve]]) -> page.Figure:
    labels = [fill(curve.label, _ROW - _LINE) for curve in next(iter(panels.values()))]
    longest = max(len(line) for label in labels for line in label.splitlines())
    columns = min(_ROW // (longest + _LINE), page.LEGEND_COLUMNS)
    rows = -(-len(labels) // columns) * max(label.count("\n") + 1 for label in labels)
    figure, stacked = page.stack([_PANEL_HEIGHT] * len(panels), rows)
    seconds = scale("s", *(curve.time for curves in panels.values() for curve in curves))
    for axes, (name, curves) in zip(stacked, panels.items(), strict=True):
        shown = scale(curves[0].unit, *(curve.values for curve in curves))
        for curve, label, (colour, dashes, _) in zip(
            curves, labels, colours.COMPARED, strict=False
        ):
            axes.plot(
                curve.time / seconds.factor,
                curve.values / shown.factor,
                color=colour,
                linestyle=dashes,
                label=label,
                rasterized=len(curve.time) > page.MOST_VECTOR_POINTS,
            )
        axes.set_ylabel(page.in_lines(shown.label(name)))
    page.finish_stack(figure, stacked, seconds.label("time"))
    page.legend(figure, stacked[0], ncols=columns)
    return figure
