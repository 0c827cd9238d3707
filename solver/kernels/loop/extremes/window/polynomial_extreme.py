"""Extremes of a channel that is a polynomial in a step, as far as eight even values can tell."""

from fractions import Fraction

import numpy as np

from jointplay.records.peak import HIGHEST, LOWEST
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.kernels.loop.extremes.search.local_extremes import CORNER
from jointplay.solver.kernels.loop.extremes.window.blank_book import RANGE
from jointplay.solver.kernels.loop.extremes.window.book import count_value
from jointplay.solver.kernels.loop.step import Step

LAST = INSTANTS - 1
MIDDLE = 0.5 * LAST


def lagrange_coefficients() -> list[list[float]]:
    """Return the coefficients of Lagrange's polynomials about the middle, each rounded once."""
    found = []
    for i in range(INSTANTS):
        powers, others = [Fraction(1)], [k for k in range(INSTANTS) if k != i]
        for k in others:
            abscissa, shifted = Fraction(MIDDLE) - k, [Fraction(0), *powers]
            powers = [
                (one + abscissa * other) / (i - k)
                for one, other in zip(shifted, [*powers, Fraction(0)], strict=True)
            ]
        found.append([float(power) for power in powers])
    return found


COEFFICIENTS = np.array(lagrange_coefficients())
"""(values, powers): the polynomial through eight values, about the middle of them."""
SEVENTH = (-1.0, 7.0, -21.0, 35.0)
"""Weights of the seventh difference, of a value less its mirror image."""
MOST_ROUNDS = 8
CLOSE = 1e-2
"""Change of the abscissa, in spacings, that ends the search: the next one would be its square,
and a value changes by the square of that."""


@inner_kernel()
def count_if_polynomial(
    r: int, begin: float, spacing: float, s: Step, book: np.ndarray, powers: np.ndarray
) -> bool:
    """Let extremes of a row inside a part of a step count, if it is a polynomial.

    Returns whether it is.

    The seventh difference shows a corner by no less than this goes beyond the values. Without one,
    the polynomial through them is off by a hundredth of that difference.

    powers : (INSTANTS,) room for coefficients.
    """
    values = s.spare[s.at.channel + r]
    if has_corner(r, s, book):
        return False
    known = False
    for i in range(INSTANTS):
        before, behind = values[max(i - 1, 0)], values[min(i + 1, LAST)]
        rise, fall = values[i] - before, values[i] - behind
        if rise * fall < 0.0:
            continue
        m = min(max(i, 1), LAST - 1)
        bend = values[m - 1] - 2.0 * values[m] + values[m + 1]
        beyond = values[i] - CORNER * bend
        if bend == 0.0 or book[LOWEST, r] <= beyond <= book[HIGHEST, r]:
            continue
        if not known:
            fit(values, powers)
            known = True
        slope = 0.5 * (values[m + 1] - values[m - 1])
        abscissa = turning_point(powers, i - MIDDLE, m - MIDDLE - slope / bend)
        value = powers[LAST]
        for k in range(LAST - 1, -1, -1):
            value = value * abscissa + powers[k]
        count_value(book, r, value, begin + spacing * (abscissa + MIDDLE))
    return True


@inner_kernel()
def has_corner(r: int, s: Step, book: np.ndarray) -> bool:
    """Whether the seventh difference of a row is too large for a polynomial."""
    values, seventh = s.spare[s.at.channel + r], 0.0
    for i in range(len(SEVENTH)):
        seventh += SEVENTH[i] * (values[i] - values[LAST - i])
    wide = max(book[RANGE, r], book[HIGHEST, r] - book[LOWEST, r])
    return not abs(seventh) <= SHARP * wide


@inner_kernel()
def fit(values: np.ndarray, powers: np.ndarray) -> None:
    """Write the coefficients (powers,) of the polynomial through even values."""
    powers[:] = 0.0
    for i in range(INSTANTS):
        for k in range(INSTANTS):
            powers[k] += COEFFICIENTS[i, k] * values[i]


@inner_kernel()
def turning_point(powers: np.ndarray, best: float, start: float) -> float:
    """Return where a polynomial turns within one spacing of an abscissa, or that end of it.

    start : where it seems to turn.
    """
    low, high = max(best - 1.0, -MIDDLE), min(best + 1.0, MIDDLE)
    abscissa = min(max(start, low), high)
    for _ in range(MOST_ROUNDS):
        rate, bend = 0.0, 0.0
        for k in range(LAST, 0, -1):
            bend = bend * abscissa + rate
            rate = rate * abscissa + k * powers[k]
        if bend == 0.0:
            break
        before = abscissa
        abscissa = min(max(abscissa - rate / bend, low), high)
        if abs(abscissa - before) < CLOSE:
            break
    return abscissa
