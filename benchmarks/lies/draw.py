"""Numbers of a random job, drawn from a point of the unit cube, so that a search can move it."""

import math
from collections.abc import Iterable
from typing import TypeVar

from numpy.random import Generator

Choice = TypeVar("Choice")

DIMENSIONS = 32
"""Numbers that a job may draw; those beyond what it draws change nothing."""
DIGITS = 12
"""Significant digits of numbers, so that a job as text is the job."""


class Draw:
    """Draws numbers in order, each from one coordinate of a point, (DIMENSIONS,) in [0, 1)."""

    def __init__(self, point: Iterable[float]) -> None:
        self._rest = iter(point)
        self.count = 0
        """Numbers drawn."""

    def even(self, low: float, high: float) -> float:
        """Return a number between two, all alike."""
        return _rounded(low + (high - low) * self._next())

    def size(self, low: float, high: float) -> float:
        """Return a number between two, all orders of magnitude alike."""
        return _rounded(low * (high / low) ** self._next())

    def one_of(self, *choices: Choice) -> Choice:
        """Return one of several."""
        return choices[int(self._next() * len(choices))]

    def _next(self) -> float:
        self.count += 1
        return next(self._rest)


def anywhere(random: Generator) -> list[float]:
    """Return a point of the unit cube."""
    return [float(x) for x in random.random(DIMENSIONS)]


def beside(point: list[float], count: int, random: Generator) -> list[float]:
    """Return a point that differs in a few of the first `count` coordinates, by little or much."""
    moved = list(point)
    width = float(random.choice([0.003, 0.03, 0.3]))
    moving = min(count, int(random.integers(1, 9)))
    for at in random.choice(count, size=moving, replace=False):
        moved[at] = (moved[at] + width * float(random.standard_normal())) % 1.0
    return moved


def _rounded(value: float) -> float:
    return 0.0 if value == 0.0 else round(value, DIGITS - 1 - math.floor(math.log10(abs(value))))
