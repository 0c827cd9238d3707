"""Force-penetration loops of single impacts: the area inside is what the contact took."""

from typing import Any, Final

import numpy as np

from jointplay.figures import between_samples, colours, page, sampling, scene_facts
from jointplay.figures.kind import NotDrawable, RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.run import Source, inside

_INSTANTS = 400
"""Even instants of a contact whose trajectory is known between samples."""
_FEWEST_SAMPLES: Final = 12
_SINGLE_HEIGHT: Final = 60.0  # mm
_PANEL_HEIGHT: Final = 44.0


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    pairs = scene_facts.chosen_pairs(source, selection)
    names = [f"{pair}.{name}" for pair in pairs for name in ("penetration", "normal_force")]
    found = scene_facts.stored(source, names)
    if source.samples:
        _contacts(source, selection)
    return found


def _contacts(source: Source, selection: Selection) -> dict[str, Any]:
    """Give the strongest contact of each pair whose values during it are known.

    Raises
    ------
    NotDrawable
        There is none; the sentence says what would show one.
    """
    sampling.window(source, selection)
    strongest = {
        pair: contact
        for pair in scene_facts.chosen_pairs(source, selection)
        if (contact := _strongest(source, pair, selection)) is not None
    }
    if not strongest:
        raise NotDrawable("No contact begins in this window of time; widen it.", "start")
    resolved = {
        pair: contact for pair, contact in strongest.items() if _is_resolved(source, contact)
    }
    if not resolved:
        raise _too_short(*next(iter(strongest.items())))
    return resolved


def _too_short(pair: str, contact: Any) -> NotDrawable:
    """Say that samples show nothing of a contact, and what would."""
    lasting = float(contact["release"] - contact["onset"])
    return NotDrawable(
        f"The strongest contact at {pair} lasts {lasting:.2g} s, from {contact['onset']:.7g} s,"
        f" too short for the samples; run the job with an output_step of {lasting / 50.0:.1g} s"
        " up to there, or choose a longer contact with start and stop.",
        "start",
    )


def _strongest(source: Source, pair: str, selection: Selection) -> Any:
    """Give the contact with the largest force that begins in the window and has ended, or None."""
    rows = sampling.impacts_of(source, pair)
    rows = rows[inside(rows["onset"], selection.start, selection.stop)]
    rows = rows[np.isfinite(rows["release"])]
    return rows[np.argmax(rows["peak_force"])] if len(rows) else None


def _samples(source: Source, contact: Any) -> tuple[int, int]:
    return source.between(float(contact["onset"]), float(contact["release"]))


def _has_samples(source: Source, contact: Any) -> bool:
    first, last = _samples(source, contact)
    return last - first >= _FEWEST_SAMPLES


def _is_resolved(source: Source, contact: Any) -> bool:
    """Tell whether a contact can be drawn; nothing is computed for that."""
    return between_samples.covers(source, float(contact["release"])) or _has_samples(
        source, contact
    )


def _loop_values(source: Source, pair: str, contact: Any) -> tuple[Floats, Floats]:
    """Give penetrations [m] and forces [N] during a contact, at samples or between them."""
    names = (f"{pair}.penetration", f"{pair}.normal_force")
    exact = between_samples.at(source, names, _instants(source, contact))
    if exact is None and not _has_samples(source, contact):
        raise _too_short(pair, contact)
    _, values = exact or sampling.joined(source, names, *_samples(source, contact))
    return values[names[0]], values[names[1]]


def _instants(source: Source, contact: Any) -> Floats:
    """Give times [s] at which a contact is drawn: even ones, and those at which steps show it.

    Even ones alone pass over the impact with which a contact begins that lasts much longer.
    """
    onset, release = float(contact["onset"]), float(contact["release"])
    even = np.linspace(onset, release, _INSTANTS)
    if source.trajectory is None:
        return even
    stepped = source.trajectory.instants(onset, release, sampling.MOST_PATH_SAMPLES)
    return even if stepped is None else np.union1d(even, stepped)


def _draw(source: Source, selection: Selection) -> page.Figure:
    contacts = _contacts(source, selection)
    figure, _, panels = page.in_columns(
        len(contacts), _SINGLE_HEIGHT, _PANEL_HEIGHT, page.LEGEND_HEIGHT
    )
    for axes, (pair, contact) in zip(panels, contacts.items(), strict=True):
        found = _loop_values(source, pair, contact)
        depth, force = (np.concatenate([[0.0], values, [0.0]]) for values in found)
        _loop(axes, pair, contact, depth, force)
    page.legend(figure, panels[0])
    return figure


def _loop(axes: page.Axes, pair: str, contact: Any, depth: Floats, force: Floats) -> None:
    metres, newtons = scale("m", depth), scale("N", force)
    x, y = depth / metres.factor, force / newtons.factor
    turn = int(np.argmax(depth))
    style: page.Style = {"color": colours.COMPUTED, "rasterized": len(x) > page.MOST_VECTOR_MARKS}
    axes.fill(
        x, y, **style | {"color": colours.UNKNOWN}, linewidth=0.0, zorder=0.5, label="dissipated"
    )
    axes.plot(x[: turn + 1], y[: turn + 1], label="loading", **style)
    axes.plot(x[turn:], y[turn:], linestyle="--", label="unloading", **style)
    axes.set_xlabel(metres.label("penetration"))
    axes.set_ylabel(newtons.label("normal force"))
    axes.set_xlim(left=min(0.0, float(x.min())))
    axes.set_ylim(bottom=0.0)
    energy = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(depth)))
    joules = scale("J", np.array([energy]))
    lost = f"{energy / joules.factor:.3g} {joules.unit} dissipated"
    page.corner_text(axes, f"{pair}\nat {contact['onset']:.6g} s\n{lost}")


IMPACT_LOOP = RunFigure(
    name="impact-loop",
    title="Force over penetration of the strongest impact at each joint with clearance",
    uses=("joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
