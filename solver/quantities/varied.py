"""Numbers of many points at once, for what was written for the number of one.

Arithmetic goes by point. A comparison may decide a branch if it comes out alike at all points; if
not, ValueError: then what was asked depends on the point, and must be asked of each by itself.
Functions that take one number, such as those of `math`, raise TypeError for two points or more.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

REFUSALS = (TypeError, ValueError, ArithmeticError)
"""Errors by which a function says that it cannot take many points at once."""


class Varied(np.ndarray):
    """A number that differs from point to point, (points,)."""

    def __bool__(self) -> bool:
        """Return what all points agree on."""
        alike = self.view(np.ndarray)
        if alike.all():
            return True
        if alike.any():
            raise ValueError("the points differ in this")
        return False

    def __round__(self, digits: int = 0) -> "Varied":
        """Return the nearest whole numbers, halves to even, as of one number."""
        if digits:
            raise TypeError("whole numbers only")
        return np.rint(self).view(Varied)


def together(numbers: Iterable[Any]) -> Any:
    """Return the number that all points have, or those of the points, (points,)."""
    found = list(numbers)
    if found.count(found[0]) == len(found):
        return found[0]
    return np.array(found).view(Varied)
