"""Figures of runs and studies, as a journal would print them, in every form from the same code.

A family: one figure a file, and a line in a registry below. Every figure takes a
`records.run.Source`, or a `records.study.StudySource`, a `Selection` and `Options`. Importing this
package does not load matplotlib; drawing does, without pyplot or a change of the caller's settings.

>>> from jointplay import figures
>>> figures.render(reader, "orbit", "svg", figures.Selection(joints=("A",)))  # doctest: +SKIP
"""

import logging
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Any, Final, NamedTuple

from jointplay.figures import page, saving, scene_facts, study_facts
from jointplay.figures.adjustment import drawn
from jointplay.figures.animation import ANIMATION, Pace, film
from jointplay.figures.basin_stability import BASIN_STABILITY
from jointplay.figures.bifurcation import BIFURCATION
from jointplay.figures.branch import BRANCH
from jointplay.figures.calibration import CALIBRATION
from jointplay.figures.certificate import CERTIFICATE
from jointplay.figures.chart import CHART
from jointplay.figures.contact_force import CONTACT_FORCE
from jointplay.figures.curves import CURVES_FIGURE
from jointplay.figures.energy import ENERGY
from jointplay.figures.exponents import EXPONENTS
from jointplay.figures.force_rose import FORCE_ROSE
from jointplay.figures.histogram import HISTOGRAM
from jointplay.figures.impact_loop import IMPACT_LOOP
from jointplay.figures.kind import (
    FigureError,
    FigureKind,
    NotDrawable,
    RunFigure,
    Selection,
    StudyFigure,
    UnknownFigure,
    is_study,
    select,
)
from jointplay.figures.mechanism import MECHANISM, draw_mechanism, render_mechanism
from jointplay.figures.multipliers import MULTIPLIERS
from jointplay.figures.options import Options, chosen_options
from jointplay.figures.orbit import ORBIT
from jointplay.figures.phase_portrait import PHASE_PORTRAIT
from jointplay.figures.section import SECTION
from jointplay.figures.sensitivity import SENSITIVITY
from jointplay.figures.spectrum import SPECTRUM
from jointplay.figures.sweep import SWEEP
from jointplay.figures.time_history import OUTPUTS, TIME_HISTORY
from jointplay.figures.work_precision import WORK_PRECISION
from jointplay.figures.xy import XY
from jointplay.records.channel import by_name
from jointplay.records.figure_form import FORMS, Form
from jointplay.records.run import Source
from jointplay.records.sensitivity.outputs import outputs
from jointplay.records.study import StudySource

__all__ = [
    "FORMS",
    "RUN_FIGURES",
    "STUDY_FIGURES",
    "FigureError",
    "FigureKind",
    "Form",
    "Listed",
    "NotDrawable",
    "Options",
    "Pace",
    "Selection",
    "UnknownFigure",
    "available",
    "chosen_options",
    "draw",
    "draw_mechanism",
    "film",
    "is_study",
    "render",
    "render_mechanism",
    "required",
    "select",
]

RUN_FIGURES: Final[dict[str, RunFigure]] = {
    figure.name: figure
    for figure in (
        OUTPUTS,
        CONTACT_FORCE,
        ORBIT,
        PHASE_PORTRAIT,
        SPECTRUM,
        MECHANISM,
        ANIMATION,
        TIME_HISTORY,
        XY,
        FORCE_ROSE,
        IMPACT_LOOP,
        ENERGY,
        HISTOGRAM,
        CERTIFICATE,
    )
}
"""Figures of one run, in the order of lists."""
STUDY_FIGURES: Final[dict[str, StudyFigure]] = {
    figure.name: figure
    for figure in (
        BIFURCATION,
        BRANCH,
        CURVES_FIGURE,
        MULTIPLIERS,
        CHART,
        BASIN_STABILITY,
        EXPONENTS,
        SWEEP,
        SENSITIVITY,
        SECTION,
        WORK_PRECISION,
        CALIBRATION,
    )
}
"""Figures of a study."""


_FAULTS: Final = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    TypeError,
    ValueError,
)
"""Errors of a program, and not of the results that it reads."""
_LOG: Final = logging.getLogger(__name__)


class Listed(NamedTuple):
    """A figure that can be drawn, with what it shows."""

    name: str
    title: str


def available(source: Source | StudySource) -> tuple[Listed, ...]:
    """List what can be drawn of these results without any selection.

    The figures of the registry whose channels were stored, then, of a run, each declared output by
    its name. Besides these, the name of any stored channel is a figure: its time history, its
    bifurcation diagram, or its extremes over the parameters; and so is a statistic of a sweep, and
    an output of a sensitivity.
    """
    registry = _registry(source).values()
    listed = [Listed(kind.name, kind.title) for kind in registry if _drawable(kind, source)]
    if not is_study(source):
        named = by_name(source.channels)
        listed += [Listed(name, named[name].long_name) for name in scene_facts.outputs(source)]
    return tuple(listed)


def required(
    source: Source | StudySource, name: str, selection: Selection | None = None
) -> tuple[str, ...]:
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


def draw(
    source: Source | StudySource,
    name: str,
    selection: Selection | None = None,
    options: Options | None = None,
) -> page.Figure:
    """Draw a figure.

    Parameters
    ----------
    source
        The results.
    name
        A figure of the registry, or a stored channel for its own picture.
    selection
        Channels, joints, window of time or points; by default all.
    options
        Of its page.

    Raises
    ------
    UnknownFigure, NotDrawable
        As for `required`, and where an option means nothing for this figure.
    """
    kind, selection = _find(source, name, selection)
    kind.channels(source, selection)
    return drawn(lambda: kind.draw(source, selection), options)


def render(
    source: Source | StudySource,
    name: str,
    form: Form,
    selection: Selection | None = None,
    options: Options | None = None,
) -> bytes:
    """Draw a figure and give the bytes of a file; errors as for `draw`."""
    options = options or Options()
    with page.style(options.font, options.font_size):
        return saving.save(draw(source, name, selection, options), form)


def _find(
    source: Source | StudySource, name: str, selection: Selection | None
) -> tuple[FigureKind[Any], Selection]:
    selection = selection or Selection()
    registry = _registry(source)
    if name in registry:
        registry[name].check(selection)
        return registry[name], selection
    of_channels = _of_channels(source)
    found = next((kind for kind, names in of_channels if name in names), None)
    if found is None:
        offered = [one for one, kind in registry.items() if _offered(kind, source)]
        raise UnknownFigure(name, offered, [one for _, names in of_channels for one in names])
    if selection.channels:
        raise NotDrawable(f"The figure {name!r} is of one channel; leave channels out.", "channels")
    found.check(selection)
    return found, replace(selection, channels=(name,))


def _of_channels(source: Source | StudySource) -> list[tuple[FigureKind[Any], Collection[str]]]:
    """Give the figures that names of channels stand for, with these names; the first one counts."""
    if not is_study(source):
        return [(TIME_HISTORY, by_name(source.channels))]
    if source.kind == "sensitivity":
        return [(SENSITIVITY, {**by_name(source.channels), **outputs(source)})]
    over_points = by_name((*source.channels, *study_facts.statistics(source)))
    diagram = by_name(source.observables) if source.kind == "bifurcation" else {}
    return [(BIFURCATION, diagram), (SWEEP, over_points)]


def _registry(source: Source | StudySource) -> Mapping[str, FigureKind[Any]]:
    return STUDY_FIGURES if is_study(source) else RUN_FIGURES


def _offered(kind: FigureKind[Any], source: Source | StudySource) -> bool:
    """Whether the results hold what a figure needs, though it may want a choice among them."""
    try:
        kind.channels(source, Selection())
    except NotDrawable as error:
        return error.cause != "name"
    return True


def _drawable(kind: FigureKind[Any], source: Source | StudySource) -> bool:
    """Whether a figure belongs into a list: one with a fault of its own leaves others there."""
    try:
        kind.channels(source, Selection())
    except NotDrawable:
        return False
    except _FAULTS:
        _LOG.exception("The figure %s could not tell whether it can be drawn.", kind.name)
        return False
    return is_study(source) or source.samples > 0
