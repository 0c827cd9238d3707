"""Plane vectors as sums of body-fixed parts: v = Σ R(θ_b) d_b.

Kept apart by frame, the product of two vectors fixed in one body needs no trigonometry, and that
of vectors fixed in two bodies only the cosine and sine of the angle between them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from jointplay.solver.quantities.scalars import Scalar, sqrt

WORLD = "ground"
"""Name of the frame that never turns."""

Pair = tuple[Scalar, Scalar]


class Orientations:
    """Cosine and sine of every frame's angle: ``frame -> (cos θ, sin θ)``."""

    def __init__(self) -> None:
        self.cosine_sine: dict[str, Pair] = {WORLD: (1.0, 0.0)}

    def between(self, first: str, second: str) -> Pair:
        """Return cosine and sine of θ_second - θ_first."""
        (c1, s1), (c2, s2) = self.cosine_sine[first], self.cosine_sine[second]
        return c1 * c2 + s1 * s2, c1 * s2 - s1 * c2


@dataclass(frozen=True)
class FrameVector:
    """A sum of vectors, each fixed in a frame: ``parts[frame] = (x, y)`` in that frame."""

    orientations: Orientations
    parts: dict[str, Pair] = field(default_factory=dict)

    def __add__(self, other: FrameVector) -> FrameVector:
        parts = dict(self.parts)
        for frame, (x, y) in other.parts.items():
            x0, y0 = parts.get(frame, (0.0, 0.0))
            parts[frame] = (x0 + x, y0 + y)
        return FrameVector(self.orientations, parts)

    def scaled(self, factor: Scalar) -> FrameVector:
        """Return factor * v."""
        parts = {frame: (factor * x, factor * y) for frame, (x, y) in self.parts.items()}
        return FrameVector(self.orientations, parts)

    def turned(self) -> FrameVector:
        """Return v after a quarter turn, (x, y) -> (-y, x): the velocity that unit spin gives."""
        return FrameVector(self.orientations, {f: (-y, x) for f, (x, y) in self.parts.items()})

    def dot(self, other: FrameVector) -> Scalar:
        """Return the scalar product."""
        total: Scalar = 0.0
        for first, (x1, y1) in self.parts.items():
            for second, (x2, y2) in other.parts.items():
                if first == second:
                    total = total + (x1 * x2 + y1 * y2)
                else:
                    cosine, sine = self.orientations.between(first, second)
                    along, across = x1 * x2 + y1 * y2, y1 * x2 - x1 * y2
                    total = total + (cosine * along + sine * across)
        return total

    def world(self) -> Pair:
        """Return the components in the world frame."""
        total_x: Scalar = 0.0
        total_y: Scalar = 0.0
        for frame, (x, y) in self.parts.items():
            cosine, sine = self.orientations.cosine_sine[frame]
            total_x = total_x + (cosine * x - sine * y)
            total_y = total_y + (sine * x + cosine * y)
        return total_x, total_y


def cross(first: Pair, second: Pair) -> Scalar:
    """Return the z component of first x second."""
    return first[0] * second[1] - first[1] * second[0]


def dot(first: Pair, second: Pair) -> Scalar:
    """Return the scalar product of two pairs of components."""
    return first[0] * second[0] + first[1] * second[1]


def left(vector: Pair) -> Pair:
    """Return a vector after a quarter turn to the left."""
    return -vector[1], vector[0]


def scaled(vector: Pair, factor: Scalar) -> Pair:
    """Return a vector times a factor."""
    return factor * vector[0], factor * vector[1]


def plus(first: Pair, second: Pair) -> Pair:
    """Return the sum of two vectors."""
    return first[0] + second[0], first[1] + second[1]


def minus(first: Pair, second: Pair) -> Pair:
    """Return the first of two vectors less the second."""
    return first[0] - second[0], first[1] - second[1]


def turned(vector: Pair, by: Pair) -> Pair:
    """Return a vector turned by an angle, whose cosine and sine are given."""
    (x, y), (cosine, sine) = vector, by
    return cosine * x - sine * y, sine * x + cosine * y


def unit(axis: Sequence[Scalar]) -> Pair:
    """Return a direction of unit length."""
    x, y = axis
    length = sqrt(x * x + y * y)
    return x / length, y / length
