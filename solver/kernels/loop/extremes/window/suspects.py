"""Channels, known at even instants of a part of a step, that may be beyond their extremes."""

from typing import NamedTuple

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.extremes.search.rounding import place_closely, scatter, spread_of
from jointplay.solver.kernels.loop.extremes.window.blank_book import ROUNDING
from jointplay.solver.kernels.loop.extremes.window.book import count_value
from jointplay.solver.kernels.loop.extremes.window.polynomial_extreme import count_if_polynomial
from jointplay.solver.kernels.loop.extremes.window.screening import JAGGED, ONE_BY_ONE, screen
from jointplay.solver.kernels.loop.step import Step


class Part(NamedTuple):
    """Part of a step in which extremes are sought, known at even instants."""

    low: float
    """Share of the step at which it begins."""
    high: float
    begin: float
    """Time of the first instant, s."""
    spacing: float
    """From one instant to the next, s."""
    sharp: float
    """Share of its range by which an extreme may be off unseen."""


@inner_kernel()
def count_each(r: int, smooth: bool, part: Part, s: Step, book: np.ndarray) -> None:
    """Let the values of a row between the ends count.

    As they are, or where a row is `smooth`, a function of time alone, the tops of parabolas.
    """
    values = s.spare[s.at.channel + r]
    for i in range(1, INSTANTS - 1):
        value, time = values[i], part.begin + part.spacing * i
        rise, fall = value - values[i - 1], value - values[i + 1]
        if smooth and rise * fall > 0.0:
            abscissa = 0.5 * (rise - fall) / (rise + fall)
            value += 0.25 * (rise - fall) * abscissa
            time += part.spacing * abscissa
        count_value(book, r, value, time)


@inner_kernel()
def is_rounding(r: int, s: Step, close: np.ndarray, book: np.ndarray) -> bool:
    """Whether what a row does in a part of a step is rounding, by what it does in no time.

    close : as `spare`, at instants `SHORT` apart. The book notes what was seen.
    """
    book[ROUNDING, r] = max(book[ROUNDING, r], scatter(close[s.at.channel + r]))
    return bool(spread_of(s.spare[s.at.channel + r], INSTANTS) <= book[ROUNDING, r])


@inner_kernel()
def find_suspects(
    part: Part, blocks: np.ndarray, s: Step, close: np.ndarray, book: np.ndarray, found: np.ndarray
) -> int:
    """Let the ends of a part of a step count, and find rows that may be beyond them inside.

    What rounding, functions of time alone and polynomials do inside counts at once: they are no
    suspects. Polynomials are where extremes need not be evaluated where they are.

    Parameters
    ----------
    blocks
        First rows of the eights that wanted rows are in.
    close : (slots, INSTANTS)
        Room for instants with hardly a distance.
    found : (width of the book,)
        Where rows are written. Returns how many.
    """
    at, begin, spacing, sharp = s.at, part.begin, part.spacing, part.sharp
    count, looked = 0, False
    end = begin + spacing * (INSTANTS - 1)
    powers = s.brackets[0].seen  # no bracket is open yet
    for first in blocks:
        marks = screen(s.spare, at.channel + first, book, first, begin, end, sharp)
        if marks == 0:
            continue
        for k in range(INSTANTS):
            mark, r = marks >> k, first + k
            rounded = mark >> ONE_BY_ONE & 1 != 0
            if mark >> JAGGED & 1:
                if not looked:
                    place_closely(0.5 * (part.low + part.high), close[at.theta])
                    generated.channels_within(s.addresses, s.work, close, s.lane)
                    looked = True
                rounded = is_rounding(r, s, close, book)
            if rounded:
                count_each(r, False, part, s, book)
            elif mark & 1 and r >= at.rows:
                count_each(r, True, part, s, book)
            elif mark & 1 and not (
                sharp > 0.0 and count_if_polynomial(r, begin, spacing, s, book, powers)
            ):
                found[count] = r
                count += 1
    return count
