"""Energy ledger over time: what drivers and gravity gave, what is lost where, what is left."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from jointplay.figures import between_samples, colours, page, sampling, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import largest_of, scale
from jointplay.figures.time_axis import TimeAxis
from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import play_of
from jointplay.records.run import Source

_HEIGHT: Final = 60.0  # mm
_LOWER_HEIGHT: Final = 40.0  # mm
_DRIVERS, _GRAVITY, _KINETIC = "drivers", "gravity", "kinetic energy"
_REST: Final = "contacts, friction, elements"
_CONTACTS, _FRICTION, _ELEMENTS, _STORED = "contacts", "friction", "elements", "stored"
_CAPTION: Final = "Since the first sample: work of drivers and gravity; gain of kinetic energy; "
_TOGETHER: Final = "the rest is lost in contacts, friction and force elements, or stored there."
_APART: Final = (
    "the rest. Below, of that: lost in contacts, in friction and in force elements; stored in"
    " contacts and elements."
)
_LEDGER: Final = " Rings: the ledger at the end, integrated with the motion; its residual is"

_LOSSES: Final = {
    _CONTACTS: "contact_loss",
    _FRICTION: "friction_loss",
    _ELEMENTS: "element_loss",
}
"""Terms of the ledger by curve."""

_ROUNDING: Final = 1e-13
"""Changes of energy no larger than this share of the energies are the rounding of these."""

Curves = dict[str, Floats]


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    drivers = scene_facts.scene(source).get("drivers") or {}
    powers = [f"{name}.power" for name in drivers]
    return scene_facts.stored(source, ["energy.kinetic", "energy.potential", *powers])


def _draw(source: Source, selection: Selection) -> page.Figure:
    names = _channels(source, selection)
    time, values = sampling.whole(source, names, selection)
    works = between_samples.works(source, time)
    curves = _curves(time, values, works)
    parts = _parts(curves, works) if _takes_energy(source) else {}
    ledger = _at_the_end(source, selection)
    across = TimeAxis(source, [time])
    residual = ledger.pop("residual", None)
    caption = _CAPTION + (_APART if parts else _TOGETHER)
    if residual is not None:
        caption += f"{_LEDGER} {residual:.1e} J.".replace("-", "−")
    heights = [_HEIGHT, _LOWER_HEIGHT] if parts else [_HEIGHT]
    figure, panels = page.stack(heights, 1 + len(heights), page.caption_height(caption))
    page.caption(figure, caption)
    for axes, shown in zip(panels, (curves, parts), strict=False):
        lines = _draw_panel(axes, shown, ledger, time, across)
        if axes is panels[0]:
            page.legend(figure, axes, ncols=3)
        else:
            style: page.Style = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 4}
            axes.legend(handles=lines, borderaxespad=0.2, **style)
    page.finish_stack(figure, panels, across.label)
    return figure


def _draw_panel(
    axes: page.Axes, curves: Curves, ledger: dict[str, float], time: Floats, across: TimeAxis
) -> list[Any]:
    """Draw curves, and a ring where the ledger has the end of one. Returns the curves."""
    lines, joules = [], scale("J", *curves.values())
    for (name, curve), (colour, dashes, _) in zip(curves.items(), colours.COMPARED, strict=False):
        style: page.Style = {"color": colour, "linestyle": dashes, "label": name}
        lines += axes.plot(*_thinned(across.shown(time), curve / joules.factor), **style)
        if name in ledger:
            end = across.shown(time[-1:]), [ledger[name] / joules.factor]
            axes.plot(*end, "o", color=colour, markersize=4.0, clip_on=False, **page.RING)
    axes.axhline(0.0, color=colours.GEOMETRY, linewidth=0.4, zorder=1.0)
    across.shade(axes)
    axes.set_ylabel(joules.label("energy"))
    return lines


def _curves(time: Floats, values: Mapping[str, Floats], works: Curves | None) -> Curves:
    """Give the terms of the balance [J] since the first sample, by name."""
    kinetic = values["energy.kinetic"] - values["energy.kinetic"][0]
    gravity = values["energy.potential"][0] - values["energy.potential"]
    power = sum((column for name, column in values.items() if name.endswith(".power")), 0.0 * time)
    steps = 0.5 * (power[1:] + power[:-1]) * np.diff(time)
    drivers = np.concatenate([[0.0], np.cumsum(steps)])
    if works is not None:
        drivers = works["driver_work"]
    rest = drivers + gravity - kinetic
    given = {_DRIVERS: drivers} if any(name.endswith(".power") for name in values) else {}
    found = {**given, _GRAVITY: gravity, _KINETIC: kinetic, _REST: rest}
    energies = ("energy.kinetic", "energy.potential")
    rounding = _ROUNDING * max(largest_of(values[name]) for name in energies)
    return {name: curve * (largest_of(curve) > rounding) for name, curve in found.items()}


def _takes_energy(source: Source) -> bool:
    """Tell whether the scene has what loses or stores the rest of the balance."""
    scene = scene_facts.scene(source)
    return bool(scene.get("forces")) or any(map(play_of, scene["joints"].values()))


def _parts(curves: Curves, works: Curves | None) -> Curves:
    """Give what the rest of the balance [J] is made of, by name; nothing where it is not known."""
    if works is None:
        return {}
    losses = {name: works[term] for name, term in _LOSSES.items()}
    stored = curves[_REST] - sum(losses.values())
    if not losses[_ELEMENTS].any():
        del losses[_ELEMENTS]
    return {**losses, _STORED: stored}


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
        **{name: energy[term] for name, term in _LOSSES.items() if term in energy},
        **({_STORED: energy["stored_change"]} if "stored_change" in energy else {}),
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
