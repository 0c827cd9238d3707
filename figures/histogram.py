"""Histograms of channels: the density of their values over time."""

from typing import Final

import numpy as np

from jointplay.figures import between_samples, colours, log_axis, page, sampling, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.figures.time_history import declared
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_BINS: Final = 48
_FEWEST_SAMPLES: Final = 32
_MOST_SAMPLES: Final = 2**20
"""Most samples: of a longer window its end is taken, where transients are over."""
_INSTANTS: Final = 2**15
"""Instants of a trajectory that is known between samples."""
_THIN: Final = 0.01
"""Share of the highest bar that most others are below where they are drawn over a logarithm."""
_PANEL_HEIGHT: Final = 34.0  # mm
_NOTHING: Final = "fewer than 32 samples, or no change"


def _draw(source: Source, selection: Selection) -> page.Figure:
    names = declared(source, selection)
    figure, grid = page.panels(len(names), 1, (_PANEL_HEIGHT + page.AXIS_HEIGHT) * len(names))
    for (axes,), name in zip(grid, names, strict=True):
        values = _samples(source, name, selection)
        shown = scale(scene_facts.channel(source, name).unit, values)
        axes.set_xlabel(shown.label(name))
        axes.set_ylabel(_density(shown.unit))
        if len(values) < _FEWEST_SAMPLES or np.ptp(values) == 0.0:
            page.instead(axes, _NOTHING)
            axes.set_xticks([])
            continue
        density, edges = np.histogram(values / shown.factor, _BINS, density=True)
        axes.stairs(density, edges, fill=True, color=colours.COMPUTED)
        filled = density[density > 0.0]
        if np.median(filled) < _THIN * filled.max():
            axes.set_yscale("log")
            axes.set_ylim(bottom=0.5 * filled.min())
            log_axis.number(axes.yaxis)
        else:
            axes.set_ylim(bottom=0.0)
    figure.align_ylabels()
    return figure


def _samples(source: Source, name: str, selection: Selection) -> Floats:
    first, last = sampling.window(source, selection)
    start, stop = between_samples.ends(source, selection)
    exact = between_samples.at(source, [name], np.linspace(start, stop, _INSTANTS))
    if exact is not None:
        return exact[1][name]
    _, columns = sampling.joined(source, [name], max(first, last - _MOST_SAMPLES), last)
    values = columns[name]
    return values[np.isfinite(values)]


def _density(unit: str) -> str:
    """Label the share of time that a unit of the channel has."""
    if not unit:
        return "density"
    return f"density [1/({unit})]" if set("/· ") & set(unit) else f"density [1/{unit}]"


HISTOGRAM = RunFigure(
    name="histogram",
    title="Histograms of the scene's declared outputs, or of chosen channels",
    uses=("channels", "start", "stop"),
    channels=declared,
    draw=_draw,
)
