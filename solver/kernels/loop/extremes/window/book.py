"""Values of channels that count in a book, and the bins that it closes; see `blank_book`."""

import math

import numpy as np

from jointplay.records.peak import HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.window.blank_book import RANGE
from jointplay.solver.kernels.loop.step import Step


@inner_kernel()
def close_bin(book: np.ndarray, rows: np.ndarray, extremes: np.ndarray) -> None:
    """Write the extremes (channels, 4) of wanted rows, and let these begin a new bin."""
    write_bin(book, rows, extremes)
    for r in rows:
        book[RANGE, r] = max(book[RANGE, r], book[HIGHEST, r] - book[LOWEST, r])
        book[LOWEST, r], book[HIGHEST, r] = math.inf, -math.inf


@inner_kernel()
def write_bin(book: np.ndarray, rows: np.ndarray, extremes: np.ndarray) -> None:
    """Write the extremes (channels, 4) of wanted rows, if they have any."""
    for c in range(len(rows)):
        if book[LOWEST, rows[c]] <= book[HIGHEST, rows[c]]:
            for line in range(RANGE):
                extremes[c, line] = book[line, rows[c]]


@inner_kernel()
def count_value(book: np.ndarray, r: int, value: float, time: float) -> None:
    """Let a value of a row at a time, s, count."""
    if value < book[LOWEST, r]:
        book[LOWEST, r], book[LOWEST_TIME, r] = value, time
    if value > book[HIGHEST, r]:
        book[HIGHEST, r], book[HIGHEST_TIME, r] = value, time


@inner_kernel()
def load_extremes(chosen: np.ndarray, book: np.ndarray, s: Step) -> None:
    """Set a lane's extremes of chosen rows to those of a book, and their ranges."""
    at = s.at
    blocks = (at.lowest, at.lowest_time, at.highest, at.highest_time, at.known_range)
    for line, block in enumerate(blocks):
        for r in chosen:
            s.work[block + r, s.lane] = book[line, r]


@inner_kernel()
def store_extremes(chosen: np.ndarray, book: np.ndarray, s: Step) -> None:
    """Set a book's extremes to those that a lane has of chosen rows."""
    at = s.at
    for line, block in enumerate((at.lowest, at.lowest_time, at.highest, at.highest_time)):
        for r in chosen:
            book[line, r] = s.work[block + r, s.lane]
