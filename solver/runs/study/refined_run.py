"""Runs a block of a map that is refined: its own points where cells are split, else inherited.

The first blocks have the coarse grid. Each other one has whole tiles. It computes the corners of
its coarsest cells itself, though other blocks have them, too, and points of its neighbours where
its cells end: it needs nothing but the study, and has the same bits whenever it is computed.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from jointplay.records.arrays import Integers
from jointplay.records.checkpoint import decode, encode, packed
from jointplay.records.coarse_to_fine import coarse_points, order_of
from jointplay.records.inherited import INHERITED
from jointplay.records.point import PointEnd
from jointplay.solver.runs.study.cell_similarity import CellSimilarity
from jointplay.solver.runs.study.cells import Cells, decided
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.restart_point import end_of_facts, facts_of_end
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.version import SOLVER_VERSION

_KIND = "refined block of a study"


class RefinedRun(StudyRun):
    """One block of a chart with `refine`; see `StudyRun`."""

    def __init__(self, study: Study, block: int, checkpoint: bytes | None = None) -> None:
        self.study = study
        first, count = study.blocks[block]
        self._order = order_of(study.job, study.shape)
        self._known: dict[int, PointEnd] = {}
        """Ends by flat index of points, the block's and others; of the coarse grid none is kept."""
        self._told: set[int] = set()
        """Indices of those among them that were results of the block."""
        coarse = coarse_points(study.shape, study.refine)
        self._origins = np.zeros(0, np.int64)
        """Indices of the origins of the block's coarsest cells."""
        if first >= coarse:
            own = self._order[first : first + count]
            self._origins = _origins(own, study.shape, 1 << study.refine)
            self._point_at = _points_at(study)
        self._similarity = CellSimilarity(study)
        self._cells = self._decided()
        """Decisions so far; they change when all of the missing points are known."""
        super().__init__(study, block, checkpoint)

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        known = [[index, facts_of_end(end)] for index, end in self._known.items()]
        facts = {"known": known, "told": sorted(self._told)}
        return encode(_KIND, SOLVER_VERSION, facts, {"run": packed(super().checkpoint())})

    def _restore(self, checkpoint: bytes) -> None:
        found = decode(checkpoint, _KIND, SOLVER_VERSION)
        self._known = {index: end_of_facts(end) for index, end in found.facts["known"]}
        self._told = set(found.facts["told"])
        self._cells = self._decided()
        super()._restore(found.content("run"))

    def _begin(self, first: int) -> list[PointRun]:
        if not len(self._origins):
            return super()._begin(first)
        return self._runs(self._cells.missing)

    def _own(self, ended: Sequence[PointEnd]) -> tuple[PointEnd, ...]:
        """Return the ends of points whose results these are."""
        marked = [replace(end, statistics={**end.statistics, INHERITED: 0.0}) for end in ended]
        if not len(self._origins):
            return tuple(marked)
        self._known |= {int(self._order[end.point]): end for end in marked}
        own = [end for end in marked if self._counts(end.point)]
        self._told |= {int(self._order[end.point]) for end in own}
        if self.over:  # all that was missing is known
            self._cells = self._decided()
            self.waiting = self._runs(self._cells.missing)
            if not self.waiting:
                own += [*self._untold(), *self._inherited()]
        return tuple(own)

    def _begun(self, started: Sequence[int]) -> tuple[int, ...]:
        every = not len(self._origins)
        return tuple(point for point in started if every or self._counts(point))

    def _counts(self, point: int) -> bool:
        """Return whether a point is one of the block's, and not only a corner of its cells."""
        return int(self._order[point]) in self._cells.computed

    def _decided(self) -> Cells:
        """Return what is decided of the block's cells."""
        return decided(
            self._origins,
            self.study.shape,
            self.study.refine,
            self._known.__contains__,
            lambda corners: self._similarity.differ(
                [[self._known[index] for index in cell] for cell in corners.tolist()]
            ),
        )

    def _runs(self, indices: Sequence[int]) -> list[PointRun]:
        points = [int(self._point_at[index]) for index in indices]
        return [PointRun(point, point, 0) for point in points]

    def _untold(self) -> Iterator[PointEnd]:
        """Yield the ends of points that were computed for other cells, before theirs was split."""
        for index in sorted(self._cells.computed - self._told):
            yield self._known[index]

    def _inherited(self) -> Iterator[PointEnd]:
        """Yield the ends of points that have the results of a cell's origin."""
        for index, origin in self._cells.inherited.items():
            end = self._known[origin]
            statistics = {**end.statistics, INHERITED: 1.0, "steps": 0.0}
            yield replace(end, point=int(self._point_at[index]), statistics=statistics)


@lru_cache(1)  # a million points take 8 MB, and a device computes many blocks at once
def _points_at(study: Study) -> Integers:
    """Return (points,) the point at each index."""
    order = order_of(study.job, study.shape)
    found = np.empty_like(order)
    found[order] = np.arange(len(order))
    return found


def _origins(indices: Integers, shape: tuple[int, ...], side: int) -> Integers:
    """Return indices of the origins of the cells that points lie in."""
    y, x = np.divmod(indices, shape[1])
    return np.unique(y // side * side * shape[1] + x // side * side)
