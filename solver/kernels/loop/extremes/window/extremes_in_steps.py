"""Extremes of channels in parts of stored steps, sought as those of a run are."""

from typing import NamedTuple

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS, MOTION
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.accepted_steps import read_steps
from jointplay.solver.kernels.loop.extremes.bends import look_between_bends
from jointplay.solver.kernels.loop.extremes.passages import look_about_passages, passes
from jointplay.solver.kernels.loop.extremes.search.local_extremes import (
    look_evenly,
    place_evenly,
    seek_between,
)
from jointplay.solver.kernels.loop.extremes.window.book import (
    close_bin,
    load_extremes,
    store_extremes,
    write_bin,
)
from jointplay.solver.kernels.loop.extremes.window.polynomial_extreme import has_corner
from jointplay.solver.kernels.loop.extremes.window.suspects import Part, find_suspects
from jointplay.solver.kernels.loop.step import Step, channels_within, group_of, step_of
from jointplay.solver.kernels.loop.unowned_view import unowned
from jointplay.solver.kernels.loop.workspace import Workspace


@inner_kernel()
def remember_start(s: Step) -> None:
    """Keep what pairs do where the step starts: the stage is there."""
    at, work = s.at, s.work
    for start, now, count in (
        (at.penetration_start, at.penetration, 1),
        (at.penetration_rate_start, at.penetration_rate, 1),
        (at.slip_start, at.slip, 1),
        (at.slip_rate_start, at.slip_rate, 1),
        (at.eccentricity_start, at.eccentricity, MOTION),
    ):
        for k in range(count * at.pairs):
            work[start + k, s.lane] = work[now + k, s.lane]


@inner_kernel()
def eights(rows: np.ndarray) -> np.ndarray:
    """Return the first row of each eight that one of ascending rows is in."""
    found, count = np.empty(len(rows), np.int64), 0
    for r in rows:
        first = r - r % INSTANTS
        if count == 0 or found[count - 1] != first:
            found[count] = first
            count += 1
    return found[:count]


class Wanted(NamedTuple):
    """Rows that are wanted, and room for some of them."""

    every: np.ndarray
    """Those that are scanned, ascending."""
    blocks: np.ndarray
    """First rows of the eights that wanted rows are in."""
    suspects: np.ndarray
    cornered: np.ndarray
    """(width of the book,) each."""
    close: np.ndarray
    """As `spare`."""


@inner_kernel()
def find_cornered(chosen: np.ndarray, s: Step, book: np.ndarray, found: np.ndarray) -> int:
    """Write those of chosen rows that no polynomial describes. Returns how many."""
    count = 0
    for r in chosen:
        if has_corner(r, s, book):
            found[count] = r
            count += 1
    return count


@inner_kernel()
def look_beside_ends(cornered: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes between the ends of a part of a step and the instants beside them.

    Where a contact ends there, a force may dip and come back: it looks as if it went straight on.
    """
    spacing = (high - low) / (INSTANTS - 1)
    for begin in (low, high - spacing):
        look_evenly(cornered, begin, begin + spacing, s)


@inner_kernel()
def look_into_part(part: Part, wanted: Wanted, s: Step, book: np.ndarray) -> None:
    """Seek extremes of wanted rows in a part of a step, and let them count in a book."""
    low, high = part.low, part.high
    place_evenly(low, high, s.spare[s.at.theta])
    channels_within(s)
    behind = find_suspects(part, wanted.blocks, s, wanted.close, book, wanted.suspects)
    passing, bending = False, s.work[s.at.may_pass_bend, s.lane] > 0.0
    for j in range(s.at.pairs):
        passing |= passes(j, s)
    chosen = wanted.every if passing or bending else wanted.suspects[:behind]
    if len(chosen) == 0:
        return
    load_extremes(chosen, book, s)
    behind = find_cornered(chosen, s, book, wanted.cornered)
    seek_between(chosen, low, high, s)
    if behind > 0 and high > low:
        look_beside_ends(wanted.cornered[:behind], low, high, s)
    if passing:
        look_about_passages(wanted.every, low, high, s)
    if bending and high > low:
        look_between_bends(wanted.every, low, high, s)
    store_extremes(chosen, book, s)


def extremes_in_steps(
    given: Workspace,
    steps: np.ndarray,
    parts: np.ndarray,
    shares: np.ndarray,
    rows: np.ndarray,
    sharp: float,
    book: np.ndarray,
    extremes: np.ndarray,
) -> None:
    """Seek extremes of channels in parts of steps, and keep those of each bin.

    Parameters
    ----------
    given
        Lanes as `states_in_steps` takes them.
    steps : (n, width)
        Consecutive steps, as `write_step` wrote them.
    parts : (k, 2)
        Step and bin of each part, both ascending; every step has a part.
    shares : (k, 2)
        Where in its step a part begins and ends.
    rows : (channels,)
        Rows of the channel block that are wanted, ascending.
    sharp
        Share of its range by which an extreme may be off unseen; 0: it is evaluated where it is.
    book
        See `solver.kernels.loop.extremes.window.blank_book`: of bin 0 so far, then of the last one.
    extremes : (bins, channels, 4)
        Lowest value, its time, highest value, its time; left as it is where a bin has no part.
    """
    group = group_of(given)
    at, work, addresses = group.at, group.work, group.addresses
    book, room = unowned(book), np.empty((2, book.shape[1]), np.int64)
    wanted = Wanted(
        rows[rows < at.rows], eights(rows), room[0], room[1], np.empty(group.spare.shape)
    )
    p, present = 0, 0
    for first in range(0, len(steps), work.shape[1]):
        count = read_steps(steps, first, group.runs, at, work)
        generated.right_hand_side(addresses, work)
        for lane in range(work.shape[1]):
            remember_start(step_of(lane, group))
        generated.attempt(addresses, work)
        generated.foresee_bends(addresses, work)
        while p < len(parts) and parts[p, 0] < first + count:
            if parts[p, 1] != present:
                close_bin(book, rows, extremes[present])
                present = parts[p, 1]
            s = step_of(parts[p, 0] - first, group)
            low, high, tried = shares[p, 0], shares[p, 1], work[at.tried, s.lane]
            begin = float(s.run.periods) * s.run.period + work[at.time, s.lane] + low * tried
            spacing = (high - low) * tried / (INSTANTS - 1)
            look_into_part(Part(low, high, begin, spacing, sharp), wanted, s, book)
            p += 1
    write_bin(book, rows, extremes[present])
