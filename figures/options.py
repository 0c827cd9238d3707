"""Options of the page that a figure is drawn on, checked."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from jointplay.figures.kind import NotDrawable
from jointplay.figures.quantity import unknown_units
from jointplay.records.page_option import OPTIONS, Option


@dataclass(frozen=True)
class Options:
    """Options of the page that a figure is drawn on; what is None is chosen for what is drawn.

    Parameters
    ----------
    width, height
        Of the page [mm].
    x_min, x_max, y_min, y_max
        Ends of the axes of all panels, in the unit that they show.
    x_scale, y_scale
        "linear" or "log".
    title
        Text above the panels.
    units
        Units to show, separated by commas, where an axis has such a quantity.
    font
        Family of the letters: "sans-serif", "serif" or "monospace".
    font_size
        Of the labels of axes [pt]; numbers, legends and captions are in proportion to it.

    Raises
    ------
    NotDrawable
        A value that is out of its range, or an unknown unit; `cause` is the option.
    """

    width: float | None = None
    height: float | None = None
    x_min: float | None = None
    x_max: float | None = None
    y_min: float | None = None
    y_max: float | None = None
    x_scale: str | None = None
    y_scale: str | None = None
    title: str | None = None
    units: str | None = None
    font: str | None = None
    font_size: float | None = None

    def __post_init__(self) -> None:
        """Check every value."""
        for name, option in OPTIONS.items():
            if (value := getattr(self, name)) is not None:
                _check(name, option, value)
        for axis in "xy":
            low, high = getattr(self, f"{axis}_min"), getattr(self, f"{axis}_max")
            if low is not None and high is not None and low >= high:
                sentence = f"The end {axis}_max ({high:g}) must be above {axis}_min ({low:g})."
                raise NotDrawable(sentence, f"{axis}_max")
        if strange := unknown_units(self.shown_units):
            raise NotDrawable(
                f"No axis can show {', '.join(strange)}; there are deg, rpm, and m, s, N, J,"
                " W, rad and what is made of them, with n, µ (or u), m, k or M before.",
                "units",
            )

    @property
    def shown_units(self) -> tuple[str, ...]:
        """Units that were asked for."""
        return tuple(part.strip() for part in (self.units or "").split(",") if part.strip())

    def given(self) -> dict[str, Any]:
        """Return what is not None, by name."""
        found = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in found.items() if value is not None}


def chosen_options(given: Mapping[str, Any]) -> Options:
    """Return options by name; TypeError if a name is none of `OPTIONS`."""
    if strange := [name for name in given if name not in OPTIONS]:
        raise TypeError(f"figures have no option {strange[0]!r}; there are {', '.join(OPTIONS)}")
    return Options(**given)


def _check(name: str, option: Option, value: Any) -> None:
    if option.choices:
        if value not in option.choices:
            *others, last = option.choices
            allowed = f"{', '.join(others)} or {last}"
            raise NotDrawable(f"The option {name} is {value!r}; it is {allowed}.", name)
    elif option.is_text:
        if not isinstance(value, str) or len(value) > option.most or not value.isprintable():
            raise NotDrawable(
                f"The option {name} is one line of at most {option.most:g} letters.", name
            )
    elif isinstance(value, str | bool) or not math.isfinite(value):
        raise NotDrawable(f"The option {name} is {value!r}; it is a number.", name)
    elif not option.least <= value <= option.most:
        unit = f" {option.unit}".rstrip()
        raise NotDrawable(
            f"The option {name} is {value:g}{unit}; it lies between {option.least:g} and"
            f" {option.most:g}{unit}.",
            name,
        )
