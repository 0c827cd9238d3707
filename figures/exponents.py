"""Exponents and verdicts over a parameter: where neighbouring motions part."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from jointplay.figures import colours, page, study_facts
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.figures.study_facts import Group
from jointplay.records.arrays import Floats
from jointplay.records.study import StudySource

_PANEL_HEIGHT: Final = 45.0  # mm
_LOW_HEIGHT: Final = 25.0
_INTERVALS: Final = 4
"""Intervals between numbers of the exponent at most: a low panel had one number, 0."""
BARS: Final = "Bars: standard errors of the exponents."


def draw_exponents(
    axes: page.Axes, source: StudySource, points: slice, across: Floats, groups: Sequence[Group]
) -> None:
    """Draw the largest Lyapunov exponent of points with its uncertainty.

    An uncertainty without bounds is a bar over the whole height.

    Parameters
    ----------
    across
        (points,) positions on the horizontal axis.
    groups
        Points of one colour.
    """
    from matplotlib.ticker import MaxNLocator

    exponents = source.indicators["lyapunov"][points]
    errors = source.indicators.get("lyapunov_error")
    reach = np.zeros_like(exponents) if errors is None else errors[points]
    axes.axhline(0.0, color=colours.GEOMETRY, linewidth=0.4, zorder=1.0)
    for group in groups:
        members = group.members[points] & np.isfinite(exponents)
        unbounded = across[members & np.isinf(reach)]
        axes.vlines(
            unbounded, 0.0, 1.0, group.colour, linewidth=0.4, transform=axes.get_xaxis_transform()
        )
        axes.errorbar(
            across[members],
            exponents[members],
            yerr=np.nan_to_num(reach[members], posinf=0.0),
            fmt="o",
            color=group.colour,
            markersize=1.6,
            markeredgewidth=0.0,
            elinewidth=0.4,
        )
    axes.yaxis.set_major_locator(MaxNLocator(_INTERVALS, steps=[1, 2, 2.5, 5, 10], min_n_ticks=3))
    axes.set_ylabel("exponent [1/s]")


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    study_facts.chosen_points(source, selection)
    if len(source.parameters) != 1:
        raise NotDrawable("Exponents are drawn over one parameter; this study has none, or more.")
    if "lyapunov" not in source.indicators:
        raise NotDrawable("The study has no exponents; ask for the indicator lyapunov.")
    return ()


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    points = study_facts.chosen_points(source, selection)
    axis = ParameterAxis(source, 0, points)
    verdicts = study_facts.by_verdict(source)
    entries = {one.name: ("o", one.colour) for one in verdicts}
    entries |= axis.legend()
    groups = verdicts or (study_facts.everything(source),)
    tested = source.indicators.get("zero_one")
    if tested is not None and not np.isfinite(tested[points]).any():
        tested = None  # too few sections for this test
    heights = [_PANEL_HEIGHT, *([_LOW_HEIGHT] if tested is not None else [])]
    figure, panels = page.stack(heights, page.legend_rows(entries), page.caption_height(BARS))
    draw_exponents(panels[0], source, points, axis.shown, groups)
    if tested is not None:
        for group in groups:
            members = group.members[points] & np.isfinite(tested[points])
            values = np.clip(tested[points][members], -0.1, 1.1)
            style: page.Style = {"color": group.colour, "markersize": 1.6, "markeredgewidth": 0.0}
            panels[1].plot(axis.shown[members], values, "o", **style)
        panels[1].set_ylim(-0.15, 1.15)
        panels[1].set_ylabel("0-1 test")
    for axes in panels:
        axis.dress(axes)
    page.finish_stack(figure, panels, axis.label)
    page.legend_of_marks(figure, entries)
    page.caption(figure, BARS)
    return figure


EXPONENTS = StudyFigure(
    name="exponents",
    title="Largest Lyapunov exponents and verdicts over the parameter",
    uses=("start", "stop"),
    channels=_channels,
    draw=_draw,
)
