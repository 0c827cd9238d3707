"""Figures laid out as they are saved, and what can be seen of their text."""

from itertools import pairwise

from matplotlib.text import Text

from jointplay import figures
from jointplay.figures import page


def drawn_with(motion, name, selection):
    with page.style():
        figure = figures.draw(motion, name, selection)
        figure.draw_without_rendering()
    return figure


def visible_texts(figure):
    outside = {  # ticks beyond the ends of an axis are there but never drawn
        label
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis.get_major_ticks()
        for label in (tick.label1, tick.label2)
        if not min(axis.get_view_interval()) <= tick.get_loc() <= max(axis.get_view_interval())
    }
    return [
        text
        for text in figure.findobj(Text)
        if text.get_text() and text.get_visible() and text not in outside
    ]


def stand_apart(figure):
    """Hold the numbers along each axis to a distance."""
    for axes in figure.axes:
        if axes.name == "polar":
            continue
        labels = [label for label in axes.get_xticklabels() if label in visible_texts(figure)]
        boxes = sorted((label.get_window_extent() for label in labels), key=lambda box: box.x0)
        for left, right in pairwise(boxes):
            assert left.x1 + 1.0 < right.x0  # dots
