"""Sensitivity: bars of what an output owes to each parameter, with intervals."""

from typing import Any, Final

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.analysis import Question, sensitivity
from jointplay.records.sensitivity.outputs import channel_beneath, outputs
from jointplay.records.study import StudySource

_ROW: Final = 7.0  # mm
_LEAST: Final = 18.0
_APART: Final = 0.4
"""Bars of a parameter, in rows."""
_MOST: Final = 20
"""Parameters: those of the longest bars."""
_BARS: Final = {
    "saltelli": ("share of the variance", ("first_order", "total")),
    "morris": ("elementary effect", ("mean_magnitude", "spread")),
    "latin-hypercube": ("rank correlation", ("rank_correlation",)),
}
"""By design, the axis and the measures that are drawn."""


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind != "sensitivity":
        raise NotDrawable("Sensitivities are drawn of a job of kind sensitivity.")
    channel = channel_beneath(source, _output(source, selection))
    return () if channel is None else (channel,)


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    found = sensitivity(source, Question(_output(source, selection)))
    if not found["measures"]:
        raise NotDrawable(found["note"])
    label, names = _BARS[found["design"]]
    measures = [found["measures"][name] for name in names]
    columns = [_columns(one) for one in measures]
    longest: Floats = np.nan_to_num(np.max([np.abs(values) for values, _, _ in columns], axis=0))
    shown = np.sort(np.argsort(-longest, kind="stable")[:_MOST])
    size = scale(measures[0]["unit"], *(high for _, _, high in columns))
    explained = _explained(found, len(shown))
    height = max(_ROW * len(shown), _LEAST) + page.AXIS_HEIGHT
    height += page.LEGEND_HEIGHT * 2 + page.caption_height(explained)
    figure, ((axes,),) = page.panels(1, 1, height)
    beside = -0.5 * _APART * (len(names) - 1)
    for name, values, (colour, *_) in zip(names, columns, colours.COMPARED, strict=False):
        drawn = [one[shown] / size.factor for one in values]
        _bars(axes, beside, drawn, color=colour, label=name.replace("_", " "))
        beside += _APART
    axes.axvline(0.0, color=colours.GEOMETRY, linewidth=0.4)
    axes.set_yticks(range(len(shown)), [found["parameters"][at] for at in shown])
    axes.set_ylim(len(shown) - 0.5, -0.5)
    axes.tick_params(axis="y", which="both", length=0.0)
    axes.set_xlabel(size.label(label))
    page.corner_text(axes, found["output"])
    page.caption(figure, explained)
    if len(names) > 1:
        page.legend(figure, axes)
    return figure


def _output(source: StudySource, selection: Selection) -> str:
    """Return an output by its name, or by that of a channel: its largest value."""
    chosen, known = at_most(1, selection.channels, "outputs"), outputs(source)
    named = (name if name in known else f"{name}.maximum" for name in chosen)
    return next(named, next(iter(known)))


def _columns(measure: dict[str, Any]) -> tuple[Floats, Floats, Floats]:
    values, low, high = (np.array(measure[name], np.float64) for name in ("values", "low", "high"))
    return values, low, high


def _bars(axes: page.Axes, beside: float, columns: list[Floats], **style: Any) -> None:
    values, low, high = columns
    reach = [np.clip(values - low, 0.0, None), np.clip(high - values, 0.0, None)]
    at = np.arange(len(values)) + beside
    axes.barh(at, values, 0.9 * _APART, **style)
    axes.errorbar(
        values,
        at,
        xerr=np.nan_to_num(reach),
        fmt="none",
        ecolor=colours.GEOMETRY,
        elinewidth=0.6,
        capsize=1.2,
    )


def _explained(found: dict[str, Any], shown: int) -> str:
    """Say what lines are, how much was used, what the answer notes, and what is left away."""
    parts = [f"Lines: {found['confidence']:.0%} intervals, of {found['rows']['used']} rows."]
    parts += filter(None, [found["note"]])
    if shown < len(found["parameters"]):
        parts.append(f"The {shown} parameters of the longest bars.")
    return " ".join(parts)


SENSITIVITY = StudyFigure(
    name="sensitivity",
    title="What an output owes to each parameter",
    uses=("channels",),
    channels=_channels,
    draw=_draw,
)
