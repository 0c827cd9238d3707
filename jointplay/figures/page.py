"""The page that every figure is drawn on: journal column width, type, colours, file formats."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock
from typing import TYPE_CHECKING, Any, Final, Literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Form = Literal["png", "svg"]

COLUMN_WIDTH: Final = 85.0
"""Width of a journal's column [mm]."""
DOTS_PER_INCH: Final = 300
LEGEND_HEIGHT: Final = 5.0
"""Height of a legend above the panels [mm]."""

# Okabe and Ito 2008: told apart with any colour vision, and in grey
BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
BLACK: Final = "#000000"
GREY: Final = "#767676"

MOST_VECTOR_POINTS: Final = 20_000
"""Longer curves become pixels inside an SVG, or no viewer would open it."""
MOST_VECTOR_MARKS: Final = 4000
"""The same for marks that stand alone; each takes ten times the bytes."""

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


def panels(
    rows: int,
    columns: int,
    height: float,
    *,
    share_x: bool | Literal["col"] = False,
    share_y: bool | Literal["row"] = False,
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
    """
    from matplotlib.figure import Figure as NewFigure

    size = (COLUMN_WIDTH / _MILLIMETRES_AN_INCH, height / _MILLIMETRES_AN_INCH)
    figure = NewFigure(figsize=size, layout="constrained")
    grid = figure.subplots(rows, columns, sharex=share_x, sharey=share_y, squeeze=False)
    return figure, [list(row) for row in grid]


def corner_text(axes: Axes, text: str) -> None:
    """Name a panel above its upper left corner."""
    axes.set_title(text, loc="left", fontsize=7.0, pad=2.5)


def legend(figure: Figure, axes: Axes) -> None:
    """Explain the curves of a panel once for all panels, above them."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, borderaxespad=0.2)


def save(figure: Figure, form: Form) -> bytes:
    """Give the bytes of a file: the same for the same figure, without date or version."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format=form, dpi=DOTS_PER_INCH, metadata=_METADATA[form])
    return buffer.getvalue()
