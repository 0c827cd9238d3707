"""Estimated errors over time, with the times at which the motion is not converged."""

import numpy as np

from jointplay.figures import colours, log_axis, page, sampling, scene_facts
from jointplay.figures.kind import NotDrawable, RunFigure, Selection, at_most
from jointplay.figures.quantity import scale
from jointplay.figures.time_axis import TimeAxis
from jointplay.records.run import CertificateRecord, Source, inside

MOST_PANELS = 8
_PANEL_HEIGHT = 24.0  # mm
_CONVERGED = (
    "Converged: the error of each journal's centre, and of the gap at each corner, wall and cam, is"
    " below a tenth of the clearance, that of each body's position below a twentieth of its range."
    " The horizon is the first end of that; impacts are certified no further."
)
_SMALLEST = 1e-12
"""Share of the largest error that a panel shows: errors below are drawn there."""


def _of(source: Source) -> CertificateRecord:
    certificate = source.certificate()
    if certificate is None or not len(certificate.arrays["time"].values):
        raise NotDrawable("These results have no certificate with errors over time.")
    return certificate


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    _of(source)
    stored = [channel.name for channel in source.channels]
    played = ([f"{pair}.eccentricity_x", f"{pair}.penetration"] for pair in source.joints)
    places = [next((name for name in names if name in stored), None) for names in played]
    usual = [*scene_facts.outputs(source), *filter(None, places)]
    names = selection.channels or usual[:MOST_PANELS] or stored[:1]
    return scene_facts.stored(source, at_most(MOST_PANELS, names))


def _draw(source: Source, selection: Selection) -> page.Figure:
    names = _channels(source, selection)
    end = float(_of(source).attributes["horizon"])
    arrays = _of(source).arrays
    time = arrays["time"].values
    chosen = inside(time, selection.start, selection.stop)
    if not chosen.any():
        raise NotDrawable(sampling.NO_SAMPLES, "start")
    time = time[chosen]
    across = TimeAxis(source, [time])
    beside = page.caption_height(_CONVERGED)
    figure, panels = page.stack([_PANEL_HEIGHT] * len(names), 1, beside)
    page.caption(figure, _CONVERGED)
    stored = [channel.name for channel in source.channels]
    for axes, name in zip(panels, names, strict=True):
        errors = arrays["error"].values[chosen, stored.index(name)]
        finite = errors[np.isfinite(errors)]
        shown = scale(scene_facts.channel(source, name).unit, finite)
        floor = _SMALLEST * float(finite.max(initial=0.0))
        if floor > 0.0:
            drawn = np.maximum(errors, floor) / shown.factor
            axes.plot(across.shown(time), drawn, color=colours.COMPUTED, label="estimated error")
            axes.set_yscale("log")
            log_axis.number(axes.yaxis, intervals=5)
        else:
            page.instead(axes, "0 everywhere" if len(finite) else "not known")
        across.shade(axes)
        if time[0] <= end <= time[-1]:
            style: page.Style = {"color": colours.MARKED, "linestyle": "--", "linewidth": 0.7}
            axes.axvline(end / across.scale.factor, label="horizon", **style)
        axes.set_ylabel(shown.label("error"))
        page.corner_text(axes, name)
    page.finish_stack(figure, panels, across.label, panels[0])
    return figure


CERTIFICATE = RunFigure(
    name="certificate",
    title="Estimated error of channels over time",
    uses=("channels", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
