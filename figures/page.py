"""The page that every figure is drawn on: width of a journal's column, type, panels, legends."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
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

Style = dict[str, Any]
"""Keywords of matplotlib's artists."""
Panels = list[list[Axes]]
"""Axes by row and column."""

COLUMN_WIDTH: Final = 85.0
"""Width of a journal's column [mm]."""
WITHOUT_SCALE: Final = "without scale"
"""Group id of axes whose place along them is no quantity: colour bars, strips of cells."""
LEGEND_HEIGHT: Final = 5.0
"""Height of a legend above the panels [mm], for each row of it."""
LEGEND_COLUMNS: Final = 4
CAPTION_LINE: Final = 2.8
"""Height of a line of a caption below the panels [mm]."""
AXIS_HEIGHT: Final = 8.0
"""Height of an axis below panels, with its label [mm]."""

RING: Final[Style] = {"markerfacecolor": "none", "markeredgewidth": 0.7}
"""An open circle around a point of a curve."""

MOST_VECTOR_POINTS: Final = 20_000
"""Longer curves become pixels inside an SVG, or no viewer would open it."""
MOST_VECTOR_MARKS: Final = 4000
"""The same for marks that stand alone; each takes ten times the bytes."""

_LONGEST_LABEL: Final = 20
_CAPTION_WIDTH: Final = 76
"""Letters in a line of a caption."""
_MILLIMETRES_AN_INCH: Final = 25.4
_TYPEFACES: Final = {
    "sans-serif": "DejaVu Sans",
    "serif": "DejaVu Serif",
    "monospace": "DejaVu Sans Mono",
}
"""Typefaces that come with matplotlib: the same everywhere."""
_WIDER: Final = {"DejaVu Serif": 1.05, "DejaVu Sans Mono": 1.2}
"""Widths of letters, as multiples of those of the style sheet's typeface."""
_SIZES: Final = (
    *("font.size", "axes.labelsize", "xtick.labelsize", "ytick.labelsize", "legend.fontsize"),
)
_STYLE: Final = Path(__file__).with_name("journal.mplstyle")
_lock: Final = RLock()


@contextmanager
def style(font: str | None = None, font_size: float | None = None) -> Iterator[None]:
    """Draw and save in our style; one thread at a time, since matplotlib's settings are global.

    Parameters
    ----------
    font, font_size
        As in `Options`; None for those of the style sheet.
    """
    import matplotlib as mpl

    with _lock, mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_settings())
        if font is not None:
            mpl.rcParams["font.family"] = _TYPEFACES[font]
        if font_size is not None:
            mpl.rcParams.update(_sizes(font_size))
        yield


def in_font(size: float) -> float:
    """Return what is `size` long at the style sheet's size of letters at the present one."""
    import matplotlib as mpl

    ratio: float = mpl.rcParams["font.size"] / _settings()["font.size"]
    return size * ratio


def _sizes(font_size: float) -> Any:
    """Return sizes of letters in the style sheet's proportions, as matplotlib's settings."""
    own = _settings()
    return {name: font_size * (own[name] / own["font.size"]) for name in _SIZES}


@cache
def _settings() -> Any:
    """Read the style sheet, once: that takes as long as all of matplotlib's defaults."""
    from matplotlib import rc_params_from_file

    return rc_params_from_file(_STYLE, use_default_template=False)


def panels(
    rows: int,
    columns: int,
    height: float,
    *,
    share_x: bool | Literal["col"] = False,
    share_y: bool | Literal["row"] = False,
    row_heights: Sequence[float] | None = None,
    projection: Literal["polar"] | None = None,
) -> tuple[Figure, Panels]:
    """Make a figure of column width, or as wide as larger letters need, and this height [mm].

    `share_x`, `share_y` and `projection` are matplotlib's; `row_heights` are relative, by default
    all the same.
    """
    from matplotlib.figure import Figure as NewFigure

    size = (_width() / _MILLIMETRES_AN_INCH, height / _MILLIMETRES_AN_INCH)
    figure = NewFigure(figsize=size, layout="constrained")
    grid = figure.subplots(
        rows,
        columns,
        sharex=share_x,
        sharey=share_y,
        squeeze=False,
        height_ratios=row_heights,
        subplot_kw={"projection": projection},
    )
    return figure, [list(row) for row in grid]


def _width() -> float:
    """Return the width of a page [mm] on which captions and legends have room."""
    import matplotlib as mpl

    (typeface,) = mpl.rcParams["font.family"]
    return COLUMN_WIDTH * max(in_font(_WIDER.get(typeface, 1.0)), 1.0)


def stack(
    heights: Sequence[float], legend_rows: int = 0, caption_height: float = 0.0
) -> tuple[Figure, list[Axes]]:
    """Make panels of these heights [mm] below one another, over the same horizontal axis."""
    words = in_font(AXIS_HEIGHT + LEGEND_HEIGHT * legend_rows)
    height = sum(heights) + words + caption_height
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
    axes.set_title(text, loc="left", fontsize=in_font(7.0), pad=2.5)


def instead(axes: Axes, text: str) -> None:
    """Say in a panel why nothing is drawn there."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center")
    axes.set_yticks([])


def in_lines(label: str) -> str:
    """Break the label of an axis before its unit where it is long, and after a part's name."""
    if len(label) <= _LONGEST_LABEL or "\n" in label:
        return label
    name, bracket, unit = label.partition(" [")
    if len(name) > _LONGEST_LABEL:
        name = name.replace(".", "\n", 1)
    return f"{name}\n[{unit}" if bracket else name


def legend_rows(entries: Sequence[Any] | Mapping[str, Any]) -> int:
    """Count the rows of a legend."""
    return -(-len(entries) // LEGEND_COLUMNS)


def legend(figure: Figure, axes: Axes, **style: Any) -> None:
    """Explain the curves of a panel once for all panels, above them; others add what is theirs."""
    style = {"ncols": LEGEND_COLUMNS, "borderaxespad": 0.2} | style
    entries: dict[str, Any] = {}
    for panel in (axes, *figure.axes):
        for handle, label in zip(*panel.get_legend_handles_labels(), strict=True):
            if not _is_empty(handle):
                entries.setdefault(label, handle)
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", **style)


def _is_empty(drawn: Any) -> bool:
    """Tell whether a curve has no points, or a bundle of lines no lines."""
    if hasattr(drawn, "get_segments"):
        return not len(drawn.get_segments())
    return hasattr(drawn, "get_xdata") and not len(drawn.get_xdata())


def legend_of_marks(
    figure: Figure, entries: Mapping[str, tuple[str, str]], lines: Axes | None = None
) -> None:
    """Explain marks that are too fine to be recognised in a legend, above the panels.

    Parameters
    ----------
    entries
        By label, marker and colour; without any there is no legend.
    lines
        Panel whose lines are explained behind them.
    """
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], linestyle="", marker=marker, color=colour, markersize=3.0, label=label)
        for label, (marker, colour) in entries.items()
    ]
    if lines is not None:
        drawn, labels = lines.get_legend_handles_labels()
        handles += dict(zip(labels, drawn, strict=True)).values()
    if handles:
        style: Style = {"ncols": LEGEND_COLUMNS, "borderaxespad": 0.2}
        if lines is None:
            style["handletextpad"] = 0.1  # a mark is in the middle of the room of a line
        figure.legend(handles=handles, loc="outside upper center", **style)


def caption_height(sentence: str) -> float:
    """Return the height of a caption [mm]; 0 of none."""
    return in_font(CAPTION_LINE) * len(_caption_lines(sentence))


def caption(figure: Figure, sentence: str) -> None:
    """Write a sentence below the panels."""
    if sentence:
        text = "\n".join(_caption_lines(sentence))
        figure.supxlabel(text, x=0.01, ha="left", fontsize=in_font(6.0))


def _caption_lines(sentence: str) -> list[str]:
    return wrap(sentence, _CAPTION_WIDTH)
