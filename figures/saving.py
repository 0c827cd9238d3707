"""Files of drawn figures: the same bytes for the same figure, without date or version."""

import io
import re
from itertools import pairwise
from typing import Any, Final

from jointplay.figures import page
from jointplay.records.figure_form import Form

DOTS_PER_INCH: Final = 300
_GAP: Final = 2.0
"""Least space between two numbers along an axis [pt]."""
_METADATA: Final[dict[Form, dict[str, str | None]]] = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": "jointplay"},
    "pdf": {"CreationDate": None, "Creator": "jointplay", "Producer": None},
    "eps": {"Creator": "jointplay"},
}
_DATE: Final = re.compile(rb"^%%CreationDate:.*\n", re.MULTILINE)


def save(figure: page.Figure, form: Form) -> bytes:
    """Give the bytes of a file.

    `savefig` draws twice, at first into nowhere, to lay the page out. It is laid out by then.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    _spread_numbers(figure)
    buffer = io.BytesIO()
    if form == "png":
        figure.set_dpi(DOTS_PER_INCH)
        canvas: Any = FigureCanvasAgg(figure)  # its stubs leave types out
        canvas.print_png(buffer, metadata=_METADATA[form])
    else:
        figure.savefig(buffer, format=form, dpi=DOTS_PER_INCH, metadata=_METADATA[form])
    found = buffer.getvalue()
    return _DATE.sub(b"", found, count=1) if form == "eps" else found


def _spread_numbers(figure: page.Figure) -> None:
    """Leave out every second number of a horizontal axis where they would touch, however long.

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
        if axes.name == "polar":  # its directions are in a circle
            continue
        while len(ticks := _crowded(axes.xaxis, gap)) > 1:
            axes.xaxis.set_major_locator(FixedLocator(ticks[::2]))
            engine.execute(figure)
    figure.set_layout_engine("none")


def _crowded(axis: page.Axis, gap: float) -> list[float]:
    """Give the positions along an axis of its numbers if two of them touch, else none."""
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
    return [position for _, _, position in shown] if touch else []
