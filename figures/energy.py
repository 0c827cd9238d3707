"""Energy ledger over time: what drivers and gravity gave, and what became of it."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.figures.time_axis import TimeAxis
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_HEIGHT: Final = 60.0  # mm
_DRIVERS, _GRAVITY, _KINETIC = "drivers", "gravity", "kinetic energy"
_REST: Final = "contacts, friction, elements"
_CAPTION: Final = (
    "Since the first sample: work of drivers and gravity; gain of kinetic energy; the rest is lost"
    " in contacts, friction and force elements, or stored there."
)
_LEDGER: Final = " Rings: the ledger at the end, integrated with the motion; its residual is"


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    drivers = scene_facts.scene(source).get("drivers") or {}
    powers = [f"{name}.power" for name in drivers]
    return scene_facts.stored(source, ["energy.kinetic", "energy.potential", *powers])


def _draw(source: Source, selection: Selection) -> page.Figure:
    names = _channels(source, selection)
    time, values = sampling.whole(source, names, selection)
    curves = _curves(time, values)
    ledger = _at_the_end(source, selection)
    joules = scale("J", *curves.values())
    across = TimeAxis(source, [time])
    residual = ledger.pop("residual", None)
    caption = _CAPTION
    if residual is not None:
        caption += f"{_LEDGER} {residual:.1e} J.".replace("-", "−")
    figure, (axes,) = page.stack([_HEIGHT], 2, page.caption_height(caption))
    page.caption(figure, caption)
    for (name, curve), (colour, dashes, _) in zip(curves.items(), colours.COMPARED, strict=False):
        look: page.Look = {"color": colour, "linestyle": dashes, "label": name}
        axes.plot(*_thinned(across.shown(time), curve / joules.factor), **look)
        if name in ledger:
            end = across.shown(time[-1:]), [ledger[name] / joules.factor]
            axes.plot(*end, "o", color=colour, markersize=4.0, clip_on=False, **page.RING)
    axes.axhline(0.0, color=colours.GEOMETRY, linewidth=0.4, zorder=1.0)
    across.shade(axes)
    axes.set_ylabel(joules.label("energy"))
    axes.set_xlabel(across.label)
    page.legend(figure, axes, ncols=3)
    return figure


def _curves(time: Floats, values: Mapping[str, Floats]) -> dict[str, Floats]:
    """Give the terms of the balance [J] since the first sample, by name."""
    kinetic = values["energy.kinetic"] - values["energy.kinetic"][0]
    gravity = values["energy.potential"][0] - values["energy.potential"]
    power = sum((column for name, column in values.items() if name.endswith(".power")), 0.0 * time)
    steps = 0.5 * (power[1:] + power[:-1]) * np.diff(time)
    drivers = np.concatenate([[0.0], np.cumsum(steps)])
    rest = drivers + gravity - kinetic
    given = {_DRIVERS: drivers} if any(name.endswith(".power") for name in values) else {}
    return {**given, _GRAVITY: gravity, _KINETIC: kinetic, _REST: rest}


def _at_the_end(source: Source, selection: Selection) -> dict[str, float]:
    """Give the ledger [J] of a whole run by curve, and its residual; nothing of a window."""
    energy = (source.attributes.get("summary") or {}).get("energy")
    if not energy or not source.complete or selection.given():
        return {}
    stored_and_lost = energy["driver_work"] + energy["gravity_work"] - energy["kinetic_change"]
    return {
        _DRIVERS: energy["driver_work"],
        _GRAVITY: energy["gravity_work"],
        _KINETIC: energy["kinetic_change"],
        _REST: stored_and_lost,
        "residual": energy["residual"],
    }


def _thinned(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Keep as many points of a curve as a page shows, extremes among them."""
    return sampling.extremes(time, values, max(2 * len(time) // sampling.MOST_SAMPLES, 1))


ENERGY = RunFigure(
    name="energy",
    title="Energy ledger over time: work of drivers and gravity, and what became of it",
    uses=("start", "stop"),
    channels=_channels,
    draw=_draw,
)
