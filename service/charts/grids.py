"""Quantities of a chart as arrays over both axes, at any resolution, kept while they are asked for.

Key of what is kept is how many points had ended: as a chart grows, its pictures do.
"""

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from jointplay.records import pyramid
from jointplay.records.attractors import Attractors, attractors_of, colour_of_attractor
from jointplay.records.channel import Channel
from jointplay.records.coarse_to_fine import over_axes
from jointplay.records.extremes import extreme, extremes
from jointplay.records.motion import (
    ATTRACTOR,
    MOTION,
    WAITING,
    Labels,
    colour_of,
    motions,
    name_of,
)
from jointplay.records.point import has_ended
from jointplay.records.point_numbers import OUTPUTS
from jointplay.service.results.stores import ResultsOfJob
from jointplay.storage.studies.reader import StudyReader

_VERDICT = "verdict"
_MOST_BYTES = 128_000_000
_TURNS = 16
_ATTRACTORS: WeakKeyDictionary[StudyReader, Attractors] = WeakKeyDictionary()
"""As long as a request has its store open."""


def quantities(store: StudyReader) -> dict[str, Channel]:
    """Return what the points of a chart have, by name, with units; labels first."""
    outputs = {**OUTPUTS, **store.own_outputs}
    found = {}
    if has_attractors(store):
        found[ATTRACTOR] = Channel(ATTRACTOR, "1", "attractor")
    if store.verdicts is not None:
        found[MOTION] = Channel(MOTION, "1", "kind of motion")
    for name in (*store.indicators, *store.statistics):
        if name != _VERDICT:
            found[name] = Channel(name, *outputs.get(name, ("1", name)))
    return found | extremes(store)


def has_attractors(store: StudyReader) -> bool:
    """Whether points have what tells their attractors apart."""
    return "states" in store.attributes and store.verdicts is not None


def _attractors(store: StudyReader) -> Attractors:
    """Return the attractors of a store as it was opened, told apart once."""
    if store not in _ATTRACTORS:
        _ATTRACTORS[store] = attractors_of(store)
    return _ATTRACTORS[store]


def names_of(store: StudyReader, name: str) -> Callable[[int], str]:
    """Return what names the labels of a quantity."""
    return _attractors(store).name_of if name == ATTRACTOR else name_of


def colours_of(name: str) -> Callable[[int], str]:
    """Return what colours the labels of a quantity."""
    return colour_of_attractor if name == ATTRACTOR else colour_of


def column(store: StudyReader, name: str) -> NDArray[Any]:
    """Return a quantity of all points in the order of computing, labels as bytes."""
    if name == ATTRACTOR:
        return _attractors(store).labels
    if name == MOTION:
        period = store.indicators.get("period", np.full(store.points, np.nan))
        verdict = store.indicators[_VERDICT]
        return motions(store.status, verdict, period, store.verdict_names)
    if name in extremes(store):
        return extreme(store, name)
    return {**store.statistics, **store.indicators}[name]


class Grid(NamedTuple):
    """A quantity over (y, x), and how many points had ended when it was read."""

    ended: int
    values: NDArray[Any]


class Grids:
    """The quantities that were asked for last, by job, points that had ended, and resolution."""

    def __init__(self) -> None:
        self._kept: OrderedDict[tuple[str, int, str, int], Grid] = OrderedDict()
        self._lock = Lock()
        self._turns = tuple(Lock() for _ in range(_TURNS))
        """One for each job, more or less: who asks second finds what the first has made."""

    def has(self, job: str, ended: int, name: str) -> bool:
        """Whether a quantity is kept at full resolution."""
        return (job, ended, name, 1) in self._kept

    def of(self, results: ResultsOfJob, ended: int, name: str, stride: int) -> Grid:
        """Return a quantity in cells of `stride` points along each side.

        `ended` : points that had ended when the caller looked. More have in what is returned if it
        was not kept then.
        """
        key = (results.job.id, ended, name, stride)
        with self._turns[hash(results.job.id) % _TURNS]:
            found = self._kept.get(key)
            if found is None:
                found = self._made(results, key)
                self._keep(key, found)
            with self._lock:
                if key in self._kept:
                    self._kept.move_to_end(key)
        return found

    def _made(self, results: ResultsOfJob, key: tuple[str, int, str, int]) -> Grid:
        job, count, name, stride = key
        if stride > 1:
            fine = self._kept.get((job, count, name, 1))
            if fine is None:
                fine = self._made(results, (job, count, name, 1))
                self._keep((job, count, name, 1), fine)
            return Grid(fine.ended, _coarse(fine.values, stride))
        store = results.study()
        order, ended = store.layout.order, has_ended(store.status)
        values = over_axes(column(store, name), order, store.shape)
        known = over_axes(ended, order, store.shape)
        if not known.all():
            values = pyramid.filled_in(values, np.asarray(known, np.bool_))
        shown = values if values.dtype == np.uint8 else values.astype(np.float32)
        return Grid(int(ended.sum()), shown)

    def _keep(self, key: tuple[str, int, str, int], grid: Grid) -> None:
        with self._lock:
            self._kept[key] = grid
            while sum(one.values.nbytes for one in self._kept.values()) > _MOST_BYTES:
                self._kept.popitem(last=False)


GRIDS = Grids()


def _coarse(fine: NDArray[Any], stride: int) -> NDArray[Any]:
    if fine.dtype == np.uint8:
        return pyramid.in_majority(np.asarray(fine, np.uint8), stride)
    return pyramid.averaged(np.asarray(fine, np.float64), stride).astype(np.float32)


def counted(labels: Labels) -> dict[int, int]:
    """Return how many points have each label, without those that wait."""
    counts = np.bincount(labels.ravel(), minlength=256)
    counts[WAITING] = 0
    return {int(label): int(counts[label]) for label in np.flatnonzero(counts)}
