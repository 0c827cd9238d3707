"""Where between two orbits of a branch something changes, between bounds."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit

FINEST = 1e-9
"""Width of the bounds of a place, as a length along the branch."""
MOST_HALVINGS = 40
WIDE = 1e-4
"""Least distance of two places, in that of the orbits, for the slope of a test function."""


@dataclass(frozen=True)
class Found:
    """A place on a branch: the orbit there, and how far it is known."""

    at: float
    """Length along the branch since the first orbit."""
    orbit: Orbit
    bounds: tuple[float, ...]
    """Largest errors of the parameters by locating it; the error of the runs comes besides."""


class NotLocated(Exception):
    """An orbit between could not be computed; the sentence says why."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Part of a branch between two orbits that are near each other, with the tangents there."""

    curve: Curve
    first: Orbit
    first_tangent: Floats
    last: Orbit
    last_tangent: Floats

    @property
    def length(self) -> float:
        """Distance of the last orbit along the first one's tangent."""
        chord = self.last.vector - self.first.vector
        return self.curve.scales.product(self.first_tangent, chord)

    def orbit(self, at: float) -> Orbit:
        """Return the orbit at a distance along the first one's tangent.

        NotLocated: Newton's method finds none.
        """
        t = at / self.length
        straight = self.length / self.curve.scales.product(self.first_tangent, self.last_tangent)
        found = self.curve.orbit(
            (1.0 + 2.0 * t) * (1.0 - t) ** 2 * self.first.vector
            + t * t * (3.0 - 2.0 * t) * self.last.vector
            + t * (1.0 - t) ** 2 * self.length * self.first_tangent
            - t * t * (1.0 - t) * straight * self.last_tangent,
            self.first_tangent,
            self.last.scale,
        )
        if isinstance(found, NoOrbit):
            raise NotLocated(found.reason)
        return found

    def direction(self, orbit: Orbit, *, coarser: bool = False) -> float:
        """Return the parameter's share of the tangent at an orbit of this piece."""
        return float(self.directions(orbit, coarser=coarser)[-1])

    def directions(self, orbit: Orbit, *, coarser: bool = False) -> Floats:
        """Return the shares of all parameters in the tangent at an orbit of this piece."""
        tangent = orbit.tangent(self.first_tangent, orbit.coarser if coarser else None)
        count = self.curve.parameters
        return np.full(count, math.nan) if tangent is None else tangent[-count:]


def root(piece: Piece, test: Callable[[Orbit], float], coarser: Callable[[Orbit], float]) -> Found:
    """Return where a test function is zero that has another sign at the other end of a piece.

    By Chandrupatla's method (Advances in Engineering Software 28:145, 1997). `coarser` : the same
    function by differences at the other scale, which tells its error.
    """
    x1, f1, x2, f2 = piece.length, test(piece.last), 0.0, test(piece.first)
    slope = (f1 - f2) / (x1 - x2)
    t, best = 0.5, piece.last
    for _ in range(MOST_HALVINGS):
        x = x1 + t * (x2 - x1)
        orbit = piece.orbit(x)
        f = test(orbit)
        if (f > 0.0) == (f1 > 0.0):
            x3, f3 = x1, f1
        else:
            x3, f3, x2, f2 = x2, f2, x1, f1
        x1, f1, best = x, f, orbit
        if abs(x2 - x1) > WIDE * piece.length:
            slope = (f2 - f1) / (x2 - x1)
        if f == 0.0:
            x2 = x1
            break
        least = FINEST / abs(x2 - x1)
        if least > 0.5:
            break
        share, value = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
        t = 0.5
        if value * value < share and (1.0 - value) ** 2 < 1.0 - share:
            t = f1 / (f1 - f2) * f3 / (f3 - f2) + (x3 - x1) / (x2 - x1) * f1 / (f1 - f3) * f2 / (
                f2 - f3
            )
        t = min(max(t, least), 1.0 - least)
    away = abs(x2 - x1) + abs(coarser(best) / slope)
    turn = (piece.directions(piece.last) - piece.directions(piece.first)) / piece.length
    bounds = away * np.abs(piece.directions(best)) + 0.5 * np.abs(turn) * away * away
    bounds = (bounds + best.residual) * piece.curve.scales.extents[-len(bounds) :]
    rounding = np.spacing(np.abs(best.values))  # of a fold, which is flat, nothing else is left
    return Found(x1, best, tuple(np.maximum(bounds, rounding).tolist()))


def change(piece: Piece, count: Callable[[Orbit], object], begin: float = 0.0) -> Found:
    """Return where a count first is not what it is at `begin`, by halving; it differs at the end.

    The orbit is the one before the change.
    """
    low, high = begin, piece.length
    before = piece.first if begin == 0.0 else piece.orbit(begin)
    behind, known = piece.last, count(before)
    while high - low > FINEST:
        middle = 0.5 * (low + high)
        orbit = piece.orbit(middle)
        if count(orbit) == known:
            low, before = middle, orbit
        else:
            high, behind = middle, orbit
    bounds = (abs(b - a) for a, b in zip(before.values, behind.values, strict=True))
    return Found(high, before, tuple(bounds))
