"""Numbers along horizontal axes that stand apart, however long they are."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

_GAP: Final = 2.0
"""Least space between two numbers [pt]."""


def spread(figure: Figure) -> None:
    """Leave out every second number of an axis where they would run into each other.

    Only a page that is laid out tells: numbers such as 0.49925 are wider than their count lets
    expect. The layout then stays as it is, for it takes as long as drawing.
    """
    from matplotlib.ticker import FixedLocator

    engine = figure.get_layout_engine()
    if engine is None:
        return
    engine.execute(figure)
    gap = _GAP * figure.dpi / 72.0
    for axes in figure.axes:
        while len(places := _crowded(axes.xaxis, gap)) > 1:
            axes.xaxis.set_major_locator(FixedLocator(places[::2]))
            engine.execute(figure)
    figure.set_layout_engine("none")


def _crowded(axis: Axis, gap: float) -> list[float]:
    """Give the places of an axis's numbers if two of them touch, else none."""
    axis.get_tightbbox(None)  # brings the numbers up to date with the page
    low, high = sorted(axis.get_view_interval())
    shown = sorted(
        (box.x0, box.x1, float(tick.get_loc()))
        for tick in axis.get_major_ticks()
        for label in (tick.label1, tick.label2)
        if low <= tick.get_loc() <= high and label.get_visible() and label.get_text()
        for box in (label.get_window_extent(),)
    )
    touch = any(right[0] - left[1] < gap for left, right in pairwise(shown))
    return [place for _, _, place in shown] if touch else []
