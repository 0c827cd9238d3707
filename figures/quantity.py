"""Numbers and units as axes show them."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats

_PREFIXES = ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"), (1e6, "M"))
_SCALABLE = re.compile(r"m|s|N|J|W|N m|N s|m/s|m/s\^2|rad|rad/s")
_NEVER_LARGER = re.compile(r"(m|s|rad)(/s(\^2)?)?")  # no mechanism is measured in kilometres
_NEVER_SMALLER = re.compile(r"rad(/s)?")
"""Angles are read to a thousandth at the finest; beyond are powers of ten."""
_OTHER: Final = {
    "deg": ("rad", math.pi / 180.0),
    "deg/s": ("rad/s", math.pi / 180.0),
    "deg/s^2": ("rad/s^2", math.pi / 180.0),
    "rpm": ("rad/s", math.pi / 30.0),
}
"""Units beside the SI's: what they measure, and what one is in SI."""
_MEASURED: Final = ("m", "s", "N", "J", "W", "rad", "N m", "N s")
_MEASURED_RATES: Final = ("m/s", "m/s^2", "rad/s", "rad/s^2")
_LARGEST_PLAIN = 1e4
_SMALLEST_PLAIN = 0.1
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_asked: ContextVar[tuple[str, ...]] = ContextVar("units that were asked for", default=())


@dataclass(frozen=True)
class Scale:
    """Scale of one axis: divided by `factor`, in `unit` ("" for a pure number)."""

    factor: float
    unit: str

    def label(self, quantity: str) -> str:
        """Label of the axis, as in `eccentricity x [mm]`."""
        return f"{quantity} [{self.unit}]" if self.unit else quantity


def scale(unit: str, *values: Floats) -> Scale:
    """Choose the unit that was asked for, else the one that keeps the axis free of powers of ten.

    Parameters
    ----------
    unit
        SI unit of the values; `1` is a pure number.
    values
        Everything that the axis shows.
    """
    if unit == "1":
        return Scale(1.0, "")
    for name in _asked.get():
        measured, factor = _known()[_plain(name)]
        if measured == unit:
            return Scale(factor, _pretty(name.replace("u", "µ", 1) if name[0] == "u" else name))
    pretty = _pretty(unit)
    largest = max((largest_of(array) for array in values), default=0.0)
    if _SMALLEST_PLAIN <= largest < _LARGEST_PLAIN or largest == 0.0:
        return Scale(1.0, pretty)
    if largest >= _LARGEST_PLAIN and _NEVER_LARGER.fullmatch(unit):
        thousands = 3 * int(math.log10(largest) // 3)
        return Scale(10.0**thousands, f"{power_of_ten(thousands)} {pretty}")
    if not _SCALABLE.fullmatch(unit):
        return Scale(1.0, pretty)
    fitting = [
        (factor, prefix)
        for factor, prefix in _PREFIXES
        if largest >= (factor if factor > 1.0 else _SMALLEST_PLAIN * factor)
    ]
    factor, prefix = fitting[-1] if fitting else _PREFIXES[0]
    if factor < 1e-3 and _NEVER_SMALLER.fullmatch(unit):
        factor, prefix = 1e-3, "m"
    return Scale(factor, prefix + pretty)


def alike(units: Sequence[str], values: Sequence[Floats]) -> list[Scale]:
    """Choose scales of panels that are compared: one for those of a unit that are of like size.

    A panel of less than a tenth of the largest has a scale of its own, as its numbers would be
    hard to read.
    """
    largest = [largest_of(array) for array in values]
    found = []
    for unit, own, size in zip(units, values, largest, strict=True):
        rivals = [other for other, same in zip(largest, units, strict=True) if same == unit]
        above = [one for one in rivals if size <= one <= 10.0 * size]
        found.append(scale(unit, np.array([max(above)])) if above else scale(unit, own))
    return found


@contextmanager
def showing(units: Iterable[str]) -> Iterator[None]:
    """Let axes show these units, of `unknown_units` none, where they measure the same."""
    before = _asked.set(tuple(units))
    try:
        yield
    finally:
        _asked.reset(before)


def unknown_units(units: Iterable[str]) -> list[str]:
    """Return those of the names that are no unit of an axis."""
    return [name for name in units if _plain(name) not in _known()]


def _known() -> dict[str, tuple[str, float]]:
    """Return all units that may be asked for, with what they measure, and what one is in SI."""
    prefixed = {
        f"{prefix}{unit}": (unit, factor)
        for unit in (*_MEASURED, *_MEASURED_RATES)
        for factor, prefix in _PREFIXES
    }
    return prefixed | _OTHER


def _plain(name: str) -> str:
    """Return a unit as the vocabulary writes it: `µm` for `um`, `N m` for `N·m` or `Nm`."""
    plain = name.replace("·", " ").replace("²", "^2")
    plain = re.sub(r"N([ms])$", r"N \1", plain)
    return f"µ{plain[1:]}" if plain.startswith("u") else plain


def per_hertz(unit: str) -> str:
    """Return the unit of a power spectral density: that of the channel squared, a hertz."""
    if unit == "1":
        return "1/Hz"
    pretty = _pretty(unit)
    return f"{pretty}²/Hz" if pretty.isalpha() else f"({pretty})²/Hz"


def power_of_ten(exponent: int) -> str:
    """Return a power of ten as text."""
    return f"10{str(exponent).translate(_SUPERSCRIPTS)}"


def _pretty(unit: str) -> str:
    raised = re.sub(r"\^(-?\d+)", lambda found: found[1].translate(_SUPERSCRIPTS), unit)
    return raised.replace(" ", "·")


def largest_of(values: Floats) -> float:
    """Return the largest size of finite values; 0 where there are none."""
    finite = values[np.isfinite(values)]
    return float(np.abs(finite).max()) if finite.size else 0.0
