"""Blocks of a study that a worker computes together on a device, each an attempt of its own.

An attempt goes as one on the processor does, from its claim to its results: it has a lease,
restart points, and hears whether to go on. But for a slice it hands back to here, where the slices
of all attempts are computed at once.
"""

import logging
import threading
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Protocol

from greenlet import getcurrent, greenlet

from jointplay.records.failure import InvalidInput
from jointplay.records.point import StudySlice
from jointplay.solver.computations import Computation, computation_of
from jointplay.solver.kernels.device.driver import DeviceError
from jointplay.solver.kinds import parse
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.required_study import required_study
from jointplay.solver.runs.study.run import StudyRun
from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import Claim
from jointplay.worker.advance import Advance
from jointplay.worker.beside import MOST_BLOCKS
from jointplay.worker.local.devices import Lanes
from jointplay.worker.local.pooled import LAUNCH
from jointplay.worker.spent import computed_on_device
from jointplay.worker.study_block import computed_by

AT_ONCE = 16
"""Blocks that are claimed with one question."""
_log = logging.getLogger(__name__)


class Blocks(Protocol):
    """Blocks as the catalogue gives them, or a service that was joined."""

    def beside(self, claim: Claim, most: int, /) -> Sequence[Claim]:
        """Claim at most so many queued blocks of a claim's study; none if none can be had."""
        ...

    def compute(self, claim: Claim, advance: Advance | None = None, /) -> None:
        """Compute a block to its end; `CatalogueError`, where its own attempt has ended.

        `advance` : that of all blocks that are computed together.
        """
        ...


def compute_on_device(
    blocks: Blocks, claim: Claim, draining: threading.Event, device: Lanes
) -> int:
    """Compute a block, and beside it blocks of its study that wait, as many as there is room for.

    What no device computes is computed by the processor.

    Returns
    -------
    int
        Blocks that were computed, or given back.

    Raises
    ------
    DeviceError
        The device cannot be opened: the processor has computed the block. Or it does not go on: the
        blocks are given back, with their last restart points.
    """
    try:
        study = required_study(parse(claim.job.spec)) if claim.block.count else None
    except InvalidInput:  # which whoever computes it tells
        study = None
    if study is None:
        blocks.compute(claim)
        return 1
    try:
        pool = Pool(study, device(study), LAUNCH)
    except InvalidInput as error:
        blocks.compute(claim)
        raise DeviceError(error.problems[0].detail) from error
    return _DeviceRun(blocks, draining, pool).run(claim)


class _DeviceRun:
    """Attempts at blocks of one study, and the lanes that they share."""

    def __init__(self, blocks: Blocks, draining: threading.Event, pool: Pool) -> None:
        self._blocks, self._draining, self._pool = blocks, draining, pool
        self._attempts: dict[int, greenlet] = {}
        """By index of the block; each waits for its next slice."""
        self._claims: dict[int, Claim] = {}
        """Those of attempts that are under way."""
        self._ended = 0
        self._advance = Advance()
        """That of all attempts: while one waits for the catalogue, none of them has stalled."""

    def run(self, first: Claim) -> int:
        """Compute the first block, and others, until none is under way; count them."""
        more = True
        try:
            self._begin(first)
            while self._attempts:
                while more and (most := self._room(first.block.count)):
                    claims = self._blocks.beside(next(iter(self._claims.values())), most)
                    for claim in claims:
                        self._begin(claim)
                    more = bool(claims)
                under_way = len(self._attempts)
                for run, piece in self._pool.advance():
                    computed_on_device(len(piece.ended))
                    self._go_on(run.block, piece)
                more = more or len(self._attempts) < under_way  # there may be others by now
        except DeviceError as error:
            for attempt in list(self._attempts.values()):
                attempt.throw(error)
            raise
        finally:
            self._pool.release()
            for attempt in self._attempts.values():
                if not attempt.dead:  # after an error of ours: leases end, and others take over
                    attempt.throw()
        return self._ended

    def _room(self, points: int) -> int:
        """Return for how many blocks of so many points there is room; 0: this process shall end."""
        if self._draining.is_set():
            return 0
        of_lanes = -(-self._pool.room // points)
        return max(min(of_lanes, AT_ONCE, MOST_BLOCKS - len(self._attempts)), 0)

    def _begin(self, claim: Claim) -> None:
        """Begin an attempt, up to its first slice."""

        def attempt() -> None:
            with computed_by(partial(self._computation, getcurrent().parent)):
                try:
                    self._blocks.compute(claim, self._advance)
                    self._ended += 1
                except (Fenced, Unavailable) as fault:
                    _log.warning("%s; leaving it", fault)

        self._attempts[claim.block.index] = greenlet(attempt)
        self._claims[claim.block.index] = claim
        self._go_on(claim.block.index)

    def _go_on(self, index: int, *piece: StudySlice) -> None:
        """Let an attempt take a slice, up to its next one, or its end."""
        attempt = self._attempts[index]
        attempt.switch(*piece)
        if attempt.dead:
            del self._attempts[index], self._claims[index]
            self._pool.drop(index)

    def _computation(
        self, here: greenlet, study: Study, index: int, carried: bytes | None
    ) -> Computation:
        """Return a block's computation, of which the pool computes the slices."""
        run = computation_of(study, index, carried)
        assert isinstance(run, StudyRun)  # noqa: S101  (of such studies alone)
        if not run.over:
            self._pool.add(run)
        return _Shared(run, here)


class _Shared:
    """A block's computation whose slices are computed elsewhere, where a greenlet waits for it."""

    def __init__(self, run: StudyRun, elsewhere: greenlet) -> None:
        self._run, self._elsewhere = run, elsewhere
        self.checkpoint = run.checkpoint
        self.seconds = 0.0
        """They are the pool's."""

    @property
    def steps(self) -> float:
        """Accepted steps since this object was made."""
        return self._run.steps

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every point of the block has ended."""
        while not self._run.over:
            yield self._elsewhere.switch()
