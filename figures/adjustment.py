"""Adjustment of a drawn figure to the options of its page."""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np

from jointplay.figures import log_axis, page
from jointplay.figures.kind import NotDrawable
from jointplay.figures.options import Options
from jointplay.figures.quantity import showing

_TITLE_HEIGHT = 5.0  # mm
_TITLE_SIZE = 8.0  # points
_MARGIN = 0.02
"""White beside values, in their span."""
_ROUNDING = 1e-9
"""A span of an axis below this, in the unit shown or in its values, is rounding."""
_LONGEST = 1000  # axis of a panel that is drawn to scale, as a multiple of the other
_MILLIMETRES_AN_INCH = 25.4


def drawn(draw: Callable[[], page.Figure], options: Options | None = None) -> page.Figure:
    """Draw a figure in our style, in the units of its options, and adjust it to the others.

    Raises
    ------
    NotDrawable
        As `adjust`.
    """
    options = options or Options()
    with page.style(options.font, options.font_size), showing(options.shown_units):
        figure = draw()
        adjust(figure, options)
    return figure


def adjust(figure: page.Figure, options: Options) -> None:
    """Give a figure the scales, limits, size and title of its options, in place.

    Raises
    ------
    NotDrawable
        An option means nothing for what is drawn; `cause` is its name.
    """
    panels = [axes for axes in figure.axes if axes.get_gid() != page.WITHOUT_SCALE]
    both: tuple[Literal["x"], Literal["y"]] = ("x", "y")
    for which in both:
        scale = getattr(options, f"{which}_scale")
        ends = getattr(options, f"{which}_min"), getattr(options, f"{which}_max")
        if scale is not None:
            _refuse_fixed(panels, f"{which}_scale")
        if ends != (None, None):
            named = f"{which}_min" if ends[0] is not None else f"{which}_max"
            _refuse_fixed([one for one in panels if one.name == "polar"], named)
            _insist_on_one_unit(panels, which, named)
        for axes in panels:
            if scale is not None:
                _rescale(axes, which, scale)
            if ends != (None, None):
                _limit(axes, which, *ends)
                _insist_on_proportions(axes, named)
    for axes in panels:
        if axes.name != "polar":
            _flatten_rounding(axes)
    _resize(figure, options)
    if options.title:
        _entitle(figure, options.title)


def _refuse_fixed(panels: list[page.Axes], option: str) -> None:
    """Refuse an option where lengths or angles are drawn to scale."""
    if any(axes.name == "polar" or axes.get_aspect() != "auto" for axes in panels):
        raise NotDrawable(f"This figure is drawn to scale; leave {option} out.", option)


def _insist_on_one_unit(panels: list[page.Axes], which: str, option: str) -> None:
    labels = [getattr(axes, f"get_{which}label")() for axes in panels]
    units = dict.fromkeys(label.partition("[")[2].rstrip("]") for label in labels if label)
    if len(units) > 1:
        shown = ", ".join(unit or "no unit" for unit in units)
        raise NotDrawable(
            f"Axes of this figure have different units ({shown}); choose one channel for {option}.",
            option,
        )


def _rescale(axes: page.Axes, which: Literal["x", "y"], scale: str) -> None:
    axis = getattr(axes, f"{which}axis")
    if scale == "linear":
        if axis.get_scale() != "linear":
            getattr(axes, f"set_{which}scale")("linear")
            axes.autoscale(axis=which)
        return
    least = getattr(axes.dataLim, f"minpos{which}")
    low, high = sorted(axis.get_view_interval())
    if not (math.isfinite(least) and high > 0.0):
        raise NotDrawable(
            "A logarithmic axis shows values above zero, and there are none.", f"{which}_scale"
        )
    if low <= 0.0:
        getattr(axes, f"set_{which}lim")(min(least, 0.5 * high), high)
    if axis.get_scale() != "log":
        getattr(axes, f"set_{which}scale")("log", nonpositive="mask")
    log_axis.number(axis)


def _limit(axes: page.Axes, which: str, low: float | None, high: float | None) -> None:
    axis = getattr(axes, f"{which}axis")
    before = sorted(axis.get_view_interval())
    if axis.get_scale() == "linear":  # the margin beyond values follows what is shown of them
        first, last = getattr(axes.dataLim, f"interval{which}")
        if low is None and high is not None and before[0] < first < high:
            before[0] = max(before[0], first - _MARGIN * (high - first))
        if high is None and low is not None and low < last < before[1]:
            before[1] = min(before[1], last + _MARGIN * (last - low))
    low, high = (old if new is None else new for old, new in zip(before, (low, high), strict=True))
    if axis.get_scale() == "log" and low <= 0.0:
        sentence = "The axis is logarithmic; its ends lie above zero."
        raise NotDrawable(sentence, f"{which}_min")
    if low >= high:
        sentence = f"All values lie beyond the limit; the axis would go from {low:g} to {high:g}."
        raise NotDrawable(sentence, f"{which}_{'min' if high in before else 'max'}")
    getattr(axes, f"set_{which}lim")(low, high)
    if axis.get_scale() == "log":
        log_axis.number(axis)


def _insist_on_proportions(axes: page.Axes, option: str) -> None:
    """Refuse ends with which a panel that is drawn to scale would be a line."""
    narrow, wide = sorted(float(np.ptp(ends)) for ends in (axes.get_xlim(), axes.get_ylim()))
    if axes.get_aspect() != "auto" and wide > _LONGEST * narrow:
        sentence = f"This figure is drawn to scale; one axis would be {_LONGEST} times the other."
        raise NotDrawable(sentence, option)


def _flatten_rounding(axes: page.Axes) -> None:
    """Widen axes whose values differ by rounding only, so that they show a constant as one."""
    for which in ("x", "y"):
        axis = getattr(axes, f"{which}axis")
        low, high = axis.get_view_interval()
        middle = (low + high) / 2.0
        if axis.get_scale() == "linear" and abs(high - low) < _ROUNDING * max(abs(middle), 1.0):
            reach = 0.1 * abs(middle) if abs(middle) > _ROUNDING else 1.0
            getattr(axes, f"set_{which}lim")(middle - reach, middle + reach)


def _resize(figure: page.Figure, options: Options) -> None:
    """Change the size of the page; one that is drawn to scale keeps its proportions."""
    if options.width is None and options.height is None:
        return
    width, height = (length * _MILLIMETRES_AN_INCH for length in figure.get_size_inches())
    if options.width is not None:
        to_scale = any(axes.get_aspect() != "auto" for axes in figure.axes)
        height *= options.width / width if to_scale else 1.0
        width = options.width
    height = height if options.height is None else options.height
    figure.set_size_inches(width / _MILLIMETRES_AN_INCH, height / _MILLIMETRES_AN_INCH)


def _entitle(figure: page.Figure, title: str) -> None:
    """Write a title above everything, on a page that is higher by it."""
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + page.in_font(_TITLE_HEIGHT) / _MILLIMETRES_AN_INCH)
    if figure.legends:  # the layout leaves room for one thing above the panels
        figure.legends[0].set_title(title)
        figure.legends[0].get_title().set_fontsize(page.in_font(_TITLE_SIZE))
    else:
        figure.suptitle(title, fontsize=page.in_font(_TITLE_SIZE))
