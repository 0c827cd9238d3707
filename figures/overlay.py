"""The same channels of several runs over one another."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.figures import page
from jointplay.figures.quantity import scale

Floats = NDArray[np.float64]

_PANEL_HEIGHT = 30.0  # mm
_AXIS_HEIGHT = 8.0
_STYLES = (
    (page.BLUE, "-"),
    (page.VERMILION, "--"),
    (page.GREEN, "-."),
    (page.BLACK, ":"),
    (page.GREY, "-"),
)
"""Colour and dashes: distinct in grey, too."""
MOST_CURVES = len(_STYLES)


@dataclass(frozen=True)
class Curve:
    """One run's channel over time [s], in a unit."""

    label: str
    unit: str
    time: Floats
    values: Floats


def draw_overlay(panels: Mapping[str, Sequence[Curve]], form: page.Form) -> bytes:
    """Return a figure with one panel for each channel, in it a curve for each run.

    Parameters
    ----------
    panels
        By channel, curves with the same labels in the same order; at most `MOST_CURVES`.
    form
        "png" or "svg".
    """
    rows = -(-max(len(curves) for curves in panels.values()) // page.LEGEND_COLUMNS)
    height = _PANEL_HEIGHT * len(panels) + _AXIS_HEIGHT + page.LEGEND_HEIGHT * rows
    with page.style():
        figure, grid = page.panels(len(panels), 1, height, share_x=True)
        every = [curve.time for curves in panels.values() for curve in curves]
        seconds = scale("s", *every)
        for (axes,), (name, curves) in zip(grid, panels.items(), strict=True):
            shown = scale(curves[0].unit, *(curve.values for curve in curves))
            for curve, (colour, dashes) in zip(curves, _STYLES, strict=False):
                axes.plot(
                    curve.time / seconds.factor,
                    curve.values / shown.factor,
                    color=colour,
                    linestyle=dashes,
                    label=curve.label,
                    rasterized=len(curve.time) > page.MOST_VECTOR_POINTS,
                )
            axes.set_ylabel(shown.label(page.in_two_lines(name)))
        grid[-1][0].set_xlabel(seconds.label("time"))
        figure.align_ylabels()
        page.legend(figure, grid[0][0])
        return page.save(figure, form)
