"""Power spectra of channels: lines where the motion is regular, a continuum where it is chaotic."""

from typing import Final

from jointplay.figures import colours, log_axis, page, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.power_density import NOTHING, aliased, driving_frequency, power_density
from jointplay.figures.quantity import per_hertz
from jointplay.figures.time_history import declared
from jointplay.records.run import Source

_DECADES: Final = 12
"""Shown below the strongest power: what lies deeper is rounding."""
_MARGIN: Final = 0.9
"""Left end of the axis, in lowest frequencies: the drivers' may be the lowest."""
_PANEL_HEIGHT: Final = 34.0  # mm


def _draw(source: Source, selection: Selection) -> page.Figure:
    names = declared(source, selection)
    drive = driving_frequency(source)
    spectra = [power_density(source, name, selection) for name in names]
    found = [one.frequency for one in spectra]
    marked = any(len(one) and one[0] <= drive <= one[-1] for one in found)
    note = aliased(source, dict(zip(names, spectra, strict=True)))
    figure, panels = page.stack([_PANEL_HEIGHT] * len(names), marked, page.caption_height(note))
    page.caption(figure, note)
    ends = [drive] if marked else []
    for axes, name, spectrum in zip(panels, names, spectra, strict=True):
        unit = scene_facts.channel(source, name).unit
        axes.set_ylabel(f"{name}\n[{per_hertz(unit)}]")
        frequency, power = spectrum.frequency, spectrum.power
        if not len(frequency):
            page.instead(axes, NOTHING)
            continue
        axes.loglog(*spectrum.thinned(), color=colours.COMPUTED, linewidth=0.6)
        top = float(power.max())
        bottom = max(top * 10.0**-_DECADES, float(power.min()) / 3.0)
        axes.set_ylim(bottom, 3.0 * top)
        ends += [_MARGIN * frequency[0], frequency[power >= bottom][-1]]
        if marked:
            style: page.Style = {
                "color": colours.MARKED,
                "linewidth": 0.7,
                "linestyle": (0, (4, 3)),
            }
            axes.axvline(drive, zorder=1.5, label="once a period of the drivers", **style)
        log_axis.number(axes.yaxis)
    if ends:
        panels[-1].set_xlim(min(ends), max(ends))
        log_axis.number(panels[-1].xaxis)
    explained = next(axes for axes in panels if axes.lines) if marked else None
    page.finish_stack(figure, panels, "frequency [Hz]", explained)
    return figure


SPECTRUM = RunFigure(
    name="spectrum",
    title="Power spectra of the scene's declared outputs, or of chosen channels",
    uses=("channels", "start", "stop"),
    channels=declared,
    draw=_draw,
)
