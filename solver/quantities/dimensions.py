"""Dimensions of SI units that are written like ``N s/m``: whether two spellings mean one."""

import re
from typing import Final

_KNOWN: Final = {
    "1": (0, 0, 0),
    "rad": (0, 0, 0),
    "m": (1, 0, 0),
    "kg": (0, 1, 0),
    "s": (0, 0, 1),
    "N": (1, 1, -2),
    "Pa": (-1, 1, -2),
    "J": (2, 1, -2),
    "W": (2, 1, -3),
}
"""Powers of m, kg and s; an angle has none."""
_FACTOR: Final = re.compile(r"([*/ ]?)([A-Za-z]+|1)(?:\^(-?\d+(?:\.\d+)?))?")


def dimensions(unit: str) -> tuple[float, ...] | None:
    """Return the powers of m, kg and s of a unit; None where it is written otherwise.

    A slash divides by the one factor behind it: N m s/rad.
    """
    powers, end = [0.0, 0.0, 0.0], 0
    for found in _FACTOR.finditer(unit):
        sign, name, power = found.groups()
        if found.start() != end or name not in _KNOWN or (sign == "") != (end == 0):
            return None
        times = float(power or 1.0) * (-1.0 if sign == "/" else 1.0)
        powers = [had + times * own for had, own in zip(powers, _KNOWN[name], strict=True)]
        end = found.end()
    return tuple(powers) if end and end == len(unit) else None
