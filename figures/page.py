"""The page that every figure is drawn on: journal column width, type, colours, file formats."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from threading import RLock
from typing import TYPE_CHECKING, Any, Final, Literal

from jointplay.figures import tick_labels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Form = Literal["png", "svg"]

COLUMN_WIDTH: Final = 85.0
"""Width of a journal's column [mm]."""
DOTS_PER_INCH: Final = 300
LEGEND_HEIGHT: Final = 5.0
"""Height of a legend above the panels [mm], for each row of it."""
LEGEND_COLUMNS: Final = 4

# Okabe and Ito 2008: distinct with any colour vision, and in grey
BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
BLACK: Final = "#000000"
GREY: Final = "#767676"
GREEN: Final = "#009E73"
SHADE: Final = "#E8E8E8"
"""Behind what is not finished."""

MOST_VECTOR_POINTS: Final = 20_000
"""Longer curves become pixels inside an SVG, or no viewer would open it."""
MOST_VECTOR_MARKS: Final = 4000
"""The same for marks that stand alone; each takes ten times the bytes."""

_LONGEST_LABEL: Final = 20
_MILLIMETRES_AN_INCH: Final = 25.4
_STYLE: Final[dict[str, Any]] = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same everywhere
    "font.size": 7.0,
    "text.parse_math": False,  # names are text, whatever signs they hold
    "axes.labelsize": 7.0,
    "axes.labelpad": 2.5,
    "axes.linewidth": 0.5,
    "axes.xmargin": 0.02,
    "xtick.labelsize": 6.5,
    "ytick.labelsize": 6.5,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "legend.fontsize": 6.5,
    "legend.frameon": False,
    "legend.handlelength": 1.5,
    "legend.columnspacing": 1.4,
    "legend.handletextpad": 0.5,
    "legend.borderpad": 0.2,
    "lines.linewidth": 0.8,
    "lines.markersize": 2.5,
    "savefig.facecolor": "white",
    "svg.fonttype": "path",
    "svg.hashsalt": "jointplay",
    "agg.path.chunksize": 10_000,
}
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
        settings: Any = mpl.rcParams  # its stubs list every key there is
        settings.update(_STYLE)
        yield


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
) -> tuple[Figure, list[list[Axes]]]:
    """Make a figure of column width.

    Parameters
    ----------
    rows, columns
        Panels.
    height
        Of the figure [mm].
    share_x, share_y
        As matplotlib's `sharex` and `sharey`.
    row_heights
        Of the rows, relative to each other; by default all the same.
    """
    from matplotlib.figure import Figure as NewFigure

    size = (COLUMN_WIDTH / _MILLIMETRES_AN_INCH, height / _MILLIMETRES_AN_INCH)
    figure = NewFigure(figsize=size, layout="constrained")
    grid = figure.subplots(
        rows,
        columns,
        sharex=share_x,
        sharey=share_y,
        squeeze=False,
        height_ratios=row_heights,
    )
    return figure, [list(row) for row in grid]


def corner_text(axes: Axes, text: str) -> None:
    """Name a panel above its upper left corner."""
    axes.set_title(text, loc="left", fontsize=7.0, pad=2.5)


def in_two_lines(label: str) -> str:
    """Break the label of an axis after the owner of a channel, where it is long and in one line."""
    if len(label) <= _LONGEST_LABEL or "\n" in label:
        return label
    owner, dot, quantity = label.partition(".")
    return f"{owner}\n{quantity}" if dot else label


def legend(figure: Figure, axes: Axes) -> None:
    """Explain the curves of a panel once for all panels, above them."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside upper center", ncols=LEGEND_COLUMNS, borderaxespad=0.2
    )


def legend_of_marks(figure: Figure, entries: Mapping[str, tuple[str, str]]) -> None:
    """Explain marks that are too fine to be recognised in a legend, above the panels.

    Parameters
    ----------
    entries
        By label, marker and colour.
    """
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], linestyle="", marker=marker, color=colour, markersize=3.0, label=label)
        for label, (marker, colour) in entries.items()
    ]
    figure.legend(
        handles=handles,
        loc="outside upper center",
        ncols=LEGEND_COLUMNS,
        borderaxespad=0.2,
        handletextpad=0.1,
    )


def save(figure: Figure, form: Form) -> bytes:
    """Give the bytes of a file: the same for the same figure, without date or version.

    `savefig` draws twice, at first into nowhere, to lay the page out. It is laid out by then.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    tick_labels.spread(figure)
    buffer = io.BytesIO()
    if form == "png":
        figure.set_dpi(DOTS_PER_INCH)
        canvas: Any = FigureCanvasAgg(figure)  # its stubs leave types out
        canvas.print_png(buffer, metadata=_METADATA[form])
    else:
        figure.savefig(buffer, format=form, dpi=DOTS_PER_INCH, metadata=_METADATA[form])
    return buffer.getvalue()
