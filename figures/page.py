"""The page that every figure is drawn on: journal column width, type, colours, file formats."""

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from pathlib import Path
from textwrap import wrap
from threading import RLock
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.axis import Axis as Axis
    from matplotlib.figure import Figure as Figure
    from matplotlib.path import Path as _Path

    MarkerPath: TypeAlias = _Path
else:  # matplotlib is loaded when something is drawn, not when a signature names its types
    Axes = Axis = Figure = MarkerPath = Any

Form = Literal["png", "svg"]
Look = dict[str, Any]
"""Keywords of matplotlib's artists."""
Panels = list[list[Axes]]
"""Axes by row and column."""

COLUMN_WIDTH: Final = 85.0
"""Width of a journal's column [mm]."""
DOTS_PER_INCH: Final = 300
LEGEND_HEIGHT: Final = 5.0
"""Height of a legend above the panels [mm], for each row of it."""
LEGEND_COLUMNS: Final = 4
CAPTION_LINE: Final = 2.5
"""Height of a line of a caption below the panels [mm]."""
AXIS_HEIGHT: Final = 8.0
"""Height of an axis below panels, with its label [mm]."""

# Okabe and Ito 2008: distinct with any colour vision, and in grey
BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
BLACK: Final = "#000000"
GREY: Final = "#767676"
GREEN: Final = "#009E73"
SHADE: Final = "#E8E8E8"
"""Behind what is not finished."""
STYLES: Final = (
    (BLUE, "-", "o"),
    (VERMILION, "--", "s"),
    (GREEN, "-.", "^"),
    (BLACK, ":", "D"),
    (GREY, "-", "v"),
)
"""Colour, dashes and mark of curves that are compared: distinct in grey, too."""
RING: Final[Look] = {"markerfacecolor": "none", "markeredgewidth": 0.7}
"""An open circle around a point of a curve."""

MOST_VECTOR_POINTS: Final = 20_000
"""Longer curves become pixels inside an SVG, or no viewer would open it."""
MOST_VECTOR_MARKS: Final = 4000
"""The same for marks that stand alone; each takes ten times the bytes."""

_LONGEST_LABEL: Final = 20
_CAPTION_WIDTH: Final = 82
"""Letters in a line of a caption."""
_GAP: Final = 2.0
"""Least space between two numbers along an axis [pt]."""
_MILLIMETRES_AN_INCH: Final = 25.4
_STYLE: Final = Path(__file__).with_name("journal.mplstyle")
_METADATA: Final[dict[Form, dict[str, str | None]]] = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": "jointplay"},
}
_lock: Final = RLock()


@contextmanager
def style() -> Iterator[None]:
    """Draw and save in our style; one thread at a time, since matplotlib's settings are global."""
    import matplotlib as mpl

    with _lock, mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_settings())
        yield


@cache
def _settings() -> Any:
    """Read the style sheet, once: that takes as long as all of matplotlib's defaults."""
    from matplotlib import rc_params_from_file

    return rc_params_from_file(_STYLE, use_default_template=False)


def warm_up() -> None:
    """Load what every figure needs, fonts too; the first one of a process else waits for it."""
    with style():
        figure, _ = panels(1, 1, 40.0)
        save(figure, "png")


def panels(
    rows: int,
    columns: int,
    height: float,
    *,
    share_x: bool | Literal["col"] = False,
    share_y: bool | Literal["row"] = False,
    row_heights: Sequence[float] | None = None,
) -> tuple[Figure, Panels]:
    """Make a figure of column width and this height [mm].

    `share_x` and `share_y` are matplotlib's; `row_heights` are relative, by default all the same.
    """
    from matplotlib.figure import Figure as NewFigure

    size = (COLUMN_WIDTH / _MILLIMETRES_AN_INCH, height / _MILLIMETRES_AN_INCH)
    figure = NewFigure(figsize=size, layout="constrained")
    grid = figure.subplots(
        rows, columns, sharex=share_x, sharey=share_y, squeeze=False, height_ratios=row_heights
    )
    return figure, [list(row) for row in grid]


def stack(
    heights: Sequence[float], legend_rows: int = 0, caption_height: float = 0.0
) -> tuple[Figure, list[Axes]]:
    """Make panels of these heights [mm] below one another, over the same horizontal axis."""
    height = sum(heights) + AXIS_HEIGHT + LEGEND_HEIGHT * legend_rows + caption_height
    figure, grid = panels(len(heights), 1, height, share_x=True, row_heights=heights)
    return figure, [row[0] for row in grid]


def finish_stack(
    figure: Figure, stacked: Sequence[Axes], across: str, explained: Axes | None = None
) -> None:
    """Label the axis below a stack, and explain the curves of one panel above it."""
    stacked[-1].set_xlabel(across)
    figure.align_ylabels()
    if explained is not None:
        legend(figure, explained)


def in_columns(
    count: int, single_height: float, row_height: float, legend_height: float
) -> tuple[Figure, Panels, list[Axes]]:
    """Make panels of one kind, two in a row; one alone has a height [mm] of its own.

    Returns the figure, all rows, and the panels in order.
    """
    columns = min(2, count)
    rows = -(-count // columns)
    height = single_height * rows if columns == 1 else row_height * rows
    figure, grid = panels(rows, columns, height + legend_height)
    in_order = [axes for row in grid for axes in row]
    for axes in in_order[count:]:
        axes.remove()
    return figure, grid, in_order[:count]


def corner_text(axes: Axes, text: str) -> None:
    """Name a panel above its upper left corner."""
    axes.set_title(text, loc="left", fontsize=7.0, pad=2.5)


def in_two_lines(label: str) -> str:
    """Break the label of an axis after the owner of a channel, where it is long and in one line."""
    if len(label) <= _LONGEST_LABEL or "\n" in label:
        return label
    owner, dot, quantity = label.partition(".")
    return f"{owner}\n{quantity}" if dot else label


def legend_rows(entries: Sequence[Any] | Mapping[str, Any]) -> int:
    """Count the rows of a legend."""
    return -(-len(entries) // LEGEND_COLUMNS)


def legend(figure: Figure, axes: Axes, **look: Any) -> None:
    """Explain the curves of a panel once for all panels, above them."""
    look = {"ncols": LEGEND_COLUMNS, "borderaxespad": 0.2} | look
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", **look)


def legend_of_marks(figure: Figure, entries: Mapping[str, tuple[str, str]]) -> None:
    """Explain marks that are too fine to be recognised in a legend, above the panels.

    Parameters
    ----------
    entries
        By label, marker and colour; without any there is no legend.
    """
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], linestyle="", marker=marker, color=colour, markersize=3.0, label=label)
        for label, (marker, colour) in entries.items()
    ]
    if handles:
        look: Look = {"ncols": LEGEND_COLUMNS, "borderaxespad": 0.2, "handletextpad": 0.1}
        figure.legend(handles=handles, loc="outside upper center", **look)


def caption_height(sentence: str) -> float:
    """Return the height of a caption [mm]; 0 of none."""
    return CAPTION_LINE * len(_caption_lines(sentence))


def caption(figure: Figure, sentence: str) -> None:
    """Write a sentence below the panels."""
    if sentence:
        text = "\n".join(_caption_lines(sentence))
        figure.supxlabel(text, x=0.01, ha="left", fontsize=5.5)


def _caption_lines(sentence: str) -> list[str]:
    return wrap(sentence, _CAPTION_WIDTH)


def save(figure: Figure, form: Form) -> bytes:
    """Give the bytes of a file: the same for the same figure, without date or version.

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
    return buffer.getvalue()


def _spread_numbers(figure: Figure) -> None:
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
