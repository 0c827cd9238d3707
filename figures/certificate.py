"""Estimated errors over time, with the times at which the motion is not converged."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from jointplay.figures import horizon, page, scene_facts
from jointplay.figures.errors import NotDrawable, at_most
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.run import CertificateRecord, Source, inside

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PANELS = 8
_PANEL_HEIGHT = 30.0  # mm
_AXIS_HEIGHT = 8.0
_SMALLEST = 1e-12
"""Share of the largest error that a panel shows: errors below are drawn there."""


def _of(source: Source) -> CertificateRecord:
    certificate = source.certificate()
    if certificate is None or not len(certificate.arrays["time"].values):
        raise NotDrawable("These results have no certificate with errors over time.")
    return certificate


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    _of(source)
    joints = scene_facts.clearances(scene_facts.scene(source))
    centres = [f"{joint}.eccentricity_x" for joint in joints]
    stored = [channel.name for channel in source.channels]
    usual = [*scene_facts.outputs(source), *(name for name in centres if name in stored)]
    names = selection.channels or usual[:MOST_PANELS] or stored[:1]
    return scene_facts.stored(source, at_most(MOST_PANELS, names))


def _draw(source: Source, selection: Selection) -> Figure:
    from matplotlib.ticker import NullLocator, StrMethodFormatter

    names = _channels(source, selection)
    end = float(_of(source).attributes["horizon"])
    arrays = _of(source).arrays
    time = arrays["time"].values
    chosen = inside(time, selection.start, selection.stop)
    if not chosen.any():
        raise NotDrawable("There are no samples in this window of time; widen it.", "start")
    time = time[chosen]
    spans = horizon.gaps(source, float(time[0]), float(time[-1]))
    height = _PANEL_HEIGHT * len(names) + _AXIS_HEIGHT + page.LEGEND_HEIGHT
    figure, grid = page.panels(len(names), 1, height, share_x=True)
    seconds = scale("s", time)
    stored = [channel.name for channel in source.channels]
    for (axes,), name in zip(grid, names, strict=True):
        errors = arrays["error"].values[chosen, stored.index(name)]
        finite = errors[np.isfinite(errors)]
        shown = scale(scene_facts.channel(source, name).unit, finite)
        floor = _SMALLEST * max(float(finite.max(initial=0.0)), np.finfo(np.float64).tiny)
        drawn = np.maximum(errors, floor) / shown.factor
        axes.plot(time / seconds.factor, drawn, color=page.BLUE, label="estimated error")
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:.3g}"))
        axes.yaxis.set_minor_locator(NullLocator())  # a low panel has room for decades
        horizon.shade(axes, spans, seconds.factor)
        if time[0] <= end <= time[-1]:
            axes.axvline(
                end / seconds.factor,
                color=page.VERMILION,
                linestyle="--",
                linewidth=0.7,
                label="horizon",
            )
        axes.set_ylabel(shown.label(f"error of\n{name}"))
    grid[-1][0].set_xlabel(seconds.label("time"))
    figure.align_ylabels()
    page.legend(figure, grid[0][0])
    return figure


CERTIFICATE = RunFigure(
    name="certificate",
    title="Estimated error of channels over time",
    uses=("channels", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
