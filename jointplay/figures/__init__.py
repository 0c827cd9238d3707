"""Figures of a run, as a journal would print them; PNG and SVG from the same code.

A family: one figure a file, the roster below. Every figure takes a `jointplay.source.Source`
and a `Selection`. Importing this package does not load matplotlib; drawing does, without
touching pyplot or the caller's settings.

>>> from jointplay import figures
>>> figures.render(reader, "orbit", "svg", figures.Selection(joints=("A",)))  # doctest: +SKIP
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final, NamedTuple

from jointplay.figures import page, scene_facts
from jointplay.figures.contact_force import CONTACT_FORCE
from jointplay.figures.errors import FigureError, NotDrawable, UnknownFigure
from jointplay.figures.kind import FigureKind, Selection
from jointplay.figures.mechanism import MECHANISM, draw_mechanism, render_mechanism
from jointplay.figures.orbit import ORBIT
from jointplay.figures.phase_portrait import PHASE_PORTRAIT
from jointplay.figures.time_history import OUTPUTS, TIME_HISTORY
from jointplay.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "ROSTER",
    "FigureError",
    "FigureKind",
    "Listed",
    "NotDrawable",
    "Selection",
    "UnknownFigure",
    "available",
    "draw",
    "draw_mechanism",
    "render",
    "render_mechanism",
    "required",
]

ROSTER: Final = (OUTPUTS, CONTACT_FORCE, ORBIT, PHASE_PORTRAIT, MECHANISM, TIME_HISTORY)


class Listed(NamedTuple):
    """A figure that can be drawn, with what it shows."""

    name: str
    title: str


def available(source: Source) -> tuple[Listed, ...]:
    """List what can be drawn of these results without any selection.

    The figures of the roster whose channels were stored, then each declared output by its name.
    Besides these, the name of any stored channel is a figure: its time history.
    """
    listed = [Listed(kind.name, kind.title) for kind in ROSTER if _drawable(kind, source)]
    named = {channel.name: channel.long_name for channel in source.channels}
    listed += [Listed(name, named[name]) for name in scene_facts.outputs(source)]
    return tuple(listed)


def required(source: Source, name: str, selection: Selection | None = None) -> tuple[str, ...]:
    """Name the channels whose values a figure reads; only source's metadata is looked at.

    Raises
    ------
    UnknownFigure
        There is no such figure or channel.
    NotDrawable
        The source or the selection lacks what the figure needs.
    """
    kind, selection = _find(source, name, selection)
    return kind.channels(source, selection)


def draw(source: Source, name: str, selection: Selection | None = None) -> Figure:
    """Draw a figure.

    Parameters
    ----------
    source
        The results.
    name
        A figure of the roster, or a stored channel for its time history.
    selection
        Channels, joints and window of time; by default all.

    Raises
    ------
    UnknownFigure
        There is no such figure or channel.
    NotDrawable
        The source or the selection lacks what the figure needs.
    """
    kind, selection = _find(source, name, selection)
    kind.channels(source, selection)
    with page.style():
        return kind.draw(source, selection)


def render(source: Source, name: str, form: page.Form, selection: Selection | None = None) -> bytes:
    """Draw a figure and give the bytes of a PNG or SVG file; errors as for `draw`."""
    with page.style():
        return page.save(draw(source, name, selection), form)


def _find(source: Source, name: str, selection: Selection | None) -> tuple[FigureKind, Selection]:
    selection = selection or Selection()
    for kind in ROSTER:
        if kind.name == name:
            return kind, selection
    if any(channel.name == name for channel in source.channels):
        return TIME_HISTORY, replace(selection, channels=(name,))
    raise UnknownFigure(name, [kind.name for kind in ROSTER])


def _drawable(kind: FigureKind, source: Source) -> bool:
    try:
        kind.channels(source, Selection())
    except NotDrawable:
        return False
    return source.samples > 0
