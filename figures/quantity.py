"""Numbers and units as axes show them."""

import re
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats

_PREFIXES = ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"), (1e6, "M"))
_SCALABLE = re.compile(r"m|s|N|J|W|N m|m/s|m/s\^2|rad|rad/s")
_NEVER_LARGER = ("m", "s", "rad", "rad/s", "m/s")  # no mechanism is measured in kilometres
_LARGEST_PLAIN = 1e4
_SMALLEST_PLAIN = 0.1
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Scale:
    """Scale of one axis: divided by `factor`, in `unit` ("" for a pure number)."""

    factor: float
    unit: str

    def label(self, quantity: str) -> str:
        """Label of the axis, as in `eccentricity x [mm]`."""
        return f"{quantity} [{self.unit}]" if self.unit else quantity


def scale(unit: str, *values: Floats) -> Scale:
    """Choose the SI prefix that keeps the axis free of powers of ten.

    Parameters
    ----------
    unit
        SI unit of the values; `1` is a pure number.
    values
        Everything that the axis shows.
    """
    if unit == "1":
        return Scale(1.0, "")
    pretty = _pretty(unit)
    largest = max((_largest(array) for array in values), default=0.0)
    plain = _SMALLEST_PLAIN <= largest < _LARGEST_PLAIN
    if plain or largest == 0.0 or not _SCALABLE.fullmatch(unit):
        return Scale(1.0, pretty)
    fitting = [
        (factor, prefix)
        for factor, prefix in _PREFIXES
        if largest >= (factor if factor > 1.0 else _SMALLEST_PLAIN * factor)
    ]
    factor, prefix = fitting[-1] if fitting else _PREFIXES[0]
    if factor > 1.0 and unit in _NEVER_LARGER:
        factor, prefix = 1.0, ""
    return Scale(factor, prefix + pretty)


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


def _largest(values: Floats) -> float:
    finite = values[np.isfinite(values)]
    return float(np.abs(finite).max()) if finite.size else 0.0
