"""Contact force at each clearance joint over time, with the impacts that samples step over."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.figures.time_axis import TimeAxis
from jointplay.records.arrays import Flags, Floats
from jointplay.records.run import Source, inside

_PANEL_HEIGHT = 34.0  # mm
_REACHED = 0.99
"""Share of a contact's peak force at which a curve shows it."""
_POINTS_OF_A_SPAN = 2
_MOST_IMPACTS = 4000
"""Lines drawn for impacts a joint: the strongest ones."""


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    pairs = scene_facts.chosen_pairs(source, selection)
    return scene_facts.stored(source, [f"{pair}.normal_force" for pair in pairs])


def _draw(source: Source, selection: Selection) -> page.Figure:
    joints = scene_facts.chosen_pairs(source, selection)
    named = [
        sampling.named_over_time(source, f"{joint}.normal_force", selection) for joint in joints
    ]
    curves = [(time, force) for time, force, _ in named]
    step = _sample_step(source, selection)
    impacts = [
        _between_samples(source, joint, selection, step, curve)
        for joint, curve in zip(joints, named, strict=True)
    ]
    newtons = scale("N", *(force for _, force in curves), *(force for _, force in impacts))
    across = TimeAxis(source, [time for time, _ in curves])
    explained = bool(across.unconverged) or any(len(onset) for onset, _ in impacts)
    figure, panels = page.stack([_PANEL_HEIGHT] * len(joints), explained)
    for axes, joint, (time, force, label), (onset, peak) in zip(
        panels, joints, named, impacts, strict=True
    ):
        axes.plot(across.shown(time), force / newtons.factor, color=colours.COMPUTED, label=label)
        style: page.Style = {"color": colours.MARKED, "linewidth": 0.5, "zorder": 1.5}
        heights = peak / newtons.factor
        axes.vlines(across.shown(onset), 0.0, heights, label="impacts between samples", **style)
        across.shade(axes)
        axes.set_ylim(bottom=0.0)
        axes.set_ylabel(newtons.label("normal force"))
        page.corner_text(axes, f"joint {joint}")
    page.finish_stack(figure, panels, across.label, panels[0] if explained else None)
    return figure


def _sample_step(source: Source, selection: Selection) -> float:
    """Mean distance of the samples in the window [s]; infinite for a single one."""
    first, last = sampling.window(source, selection)
    if last - first < 2:
        return np.inf
    begin, end = (sampling.time_of(source, index) for index in (first, last - 1))
    return (end - begin) / (last - first - 1)


def _between_samples(
    source: Source, joint: str, selection: Selection, step: float, curve: tuple[Floats, Floats, str]
) -> tuple[Floats, Floats]:
    """Give onset [s] and peak force [N] of the contacts that are too short for the curve."""
    rows = sampling.impacts_of(source, joint)
    rows = rows[inside(rows["onset"], selection.start, selection.stop)]
    rows = rows[rows["release"] - rows["onset"] < 2.0 * step]
    time, force, label = curve
    beside = _POINTS_OF_A_SPAN if label == sampling.TRAJECTORY else 0
    rows = rows[_missed(rows, time, force, beside)]
    rows = rows[np.argsort(-rows["peak_force"], kind="stable")[:_MOST_IMPACTS]]
    return rows["onset"], rows["peak_force"]


def _missed(rows: NDArray[Any], time: Floats, force: Floats, beside: int) -> Flags:
    """Tell of each contact whether the curve stays below its peak.

    `beside` : points before and after it that count, where a stronger contact in the same span may
    be drawn in its stead.
    """
    first = np.searchsorted(time, rows["onset"], side="left")
    behind = np.searchsorted(time, rows["release"], side="right")
    spans = zip(np.maximum(first - beside, 0), behind + beside, strict=True)
    highest = [force[a:b].max(initial=0.0) for a, b in spans]
    return np.asarray(np.array(highest) < _REACHED * rows["peak_force"], dtype=bool)


CONTACT_FORCE = RunFigure(
    name="contact-force",
    title="Contact force at each clearance joint",
    uses=("joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
