"""Options of a figure's page, the same for every figure: size, limits, scales, title, units, font.

Figures, service, client and command line take names, meanings and ranges from here.
"""

from typing import Final, NamedTuple

SCALES: Final = ("linear", "log")
FAMILIES: Final = ("sans-serif", "serif", "monospace")
_NARROWEST, _LOWEST = 80.0, 30.0  # mm: a legend must fit beside its page's edges
_WIDEST, _HIGHEST = 210.0, 297.0  # mm: of A4
_SMALLEST, _LARGEST = 5.0, 10.0  # pt: letters that journals print
_FURTHEST = 1e30  # of an end of an axis; beyond this its numbers cannot be drawn
_LONGEST_TITLE: Final = 200
_LONGEST_UNITS: Final = 100


class Option(NamedTuple):
    """Meaning and range of one option.

    Numbers lie from `least` to `most`, in `unit` ("" is that of the axis); words are among
    `choices`; other text has `most` letters at most.
    """

    help: str
    unit: str = ""
    least: float = -_FURTHEST
    most: float = _FURTHEST
    choices: tuple[str, ...] = ()
    is_text: bool = False


_LIMIT: Final = "in the unit that the axis shows"
OPTIONS: Final[dict[str, Option]] = {
    "width": Option(
        "Width of the page; default 85, a journal's column, more for larger letters",
        "mm",
        _NARROWEST,
        _WIDEST,
    ),
    "height": Option("Height of the page; default as the panels need", "mm", _LOWEST, _HIGHEST),
    "x_min": Option(f"Left end of horizontal axes, {_LIMIT}"),
    "x_max": Option(f"Right end of horizontal axes, {_LIMIT}"),
    "y_min": Option(f"Lower end of vertical axes, {_LIMIT}"),
    "y_max": Option(f"Upper end of vertical axes, {_LIMIT}"),
    "x_scale": Option("Scale of horizontal axes; default as the values ask for", choices=SCALES),
    "y_scale": Option("Scale of vertical axes; default as the values ask for", choices=SCALES),
    "title": Option("Title above the panels", most=_LONGEST_TITLE, is_text=True),
    "units": Option(
        "Units of axes where they fit, such as mm,kN,ms,deg,rpm; default by size",
        most=_LONGEST_UNITS,
        is_text=True,
    ),
    "font": Option("Family of the letters; default sans-serif", choices=FAMILIES),
    "font_size": Option("Size of the letters; default 7", "pt", _SMALLEST, _LARGEST),
}
