"""Blocks of a study that a worker computes together on a device, each an attempt of its own.

An attempt goes as one on the processor does, from its claim to its results: it has a lease,
restart points, and hears whether to go on. But for a slice it hands back to here, where the slices
of all attempts are computed at once.
"""

import logging
import threading
from collections import deque
from collections.abc import Iterator
from functools import partial

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
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import BlockState, Claim
from jointplay.storage.settings import Settings
from jointplay.worker.local.devices import Lanes
from jointplay.worker.local.pooled import LAUNCH
from jointplay.worker.own_solver import own_solver
from jointplay.worker.presence import own_name
from jointplay.worker.scratch.computing import compute
from jointplay.worker.spent import computed_on_device
from jointplay.worker.study_block import computed_by

MOST_BLOCKS = 256
"""That a worker holds at a time: each has a thread for its lease, and restart points."""
_log = logging.getLogger(__name__)


def compute_on_device(
    catalogue: Catalogue,
    settings: Settings,
    claim: Claim,
    draining: threading.Event,
    device: Lanes,
) -> None:
    """Compute a block, and beside it blocks of its study that wait, as many as there is room for.

    What no device computes is computed by the processor.

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
        compute(catalogue, settings, claim, draining)
        return
    try:
        pool = Pool(study, device(study), LAUNCH)
    except InvalidInput as error:
        compute(catalogue, settings, claim, draining)
        raise DeviceError(error.problems[0].detail) from error
    _DeviceRun(catalogue, settings, draining, pool).run(claim)


class _DeviceRun:
    """Attempts at blocks of one study, and the lanes that they share."""

    def __init__(
        self, catalogue: Catalogue, settings: Settings, draining: threading.Event, pool: Pool
    ) -> None:
        self._catalogue, self._settings, self._draining = catalogue, settings, draining
        self._pool = pool
        self._attempts: dict[int, greenlet] = {}
        """By index of the block; each waits for its next slice."""

    def run(self, first: Claim) -> None:
        """Compute the first block, and others, until none is under way."""
        waiting = self._waiting(first)
        try:
            self._begin(first)
            while self._attempts:
                while waiting and self._has_room():
                    self._claim(waiting.popleft())
                for run, piece in self._pool.advance():
                    computed_on_device(len(piece.ended))
                    self._go_on(run.block, piece)
        except DeviceError as error:
            for attempt in list(self._attempts.values()):
                attempt.throw(error)
            raise
        finally:
            self._pool.release()
            for attempt in self._attempts.values():
                if not attempt.dead:  # after an error of ours: leases end, and others take over
                    attempt.throw()

    def _waiting(self, first: Claim) -> deque[str]:
        """Return the ids of the study's other blocks that nobody has."""
        try:
            blocks = self._catalogue.blocks(first.job.id)
        except Unavailable as fault:
            _log.warning("block %s is computed alone: %s", first.block.id, fault)
            return deque()
        return deque(one.id for one in blocks if one.state is BlockState.queued and one.count)

    def _has_room(self) -> bool:
        most = self._settings.most_running or MOST_BLOCKS
        full = len(self._attempts) >= min(most, MOST_BLOCKS)
        return self._pool.room > 0 and not full and not self._draining.is_set()

    def _claim(self, block: str) -> None:
        try:
            claim = self._catalogue.claim_block(
                block, own_name(), self._settings.lease, own_solver()
            )
        except Unavailable as fault:
            _log.warning("block %s is not claimed: %s", block, fault)
            return
        if claim is not None:
            self._begin(claim)

    def _begin(self, claim: Claim) -> None:
        """Begin an attempt, up to its first slice."""

        def attempt() -> None:
            with computed_by(partial(self._computation, getcurrent().parent)):
                compute(self._catalogue, self._settings, claim, self._draining)

        self._attempts[claim.block.index] = greenlet(attempt)
        self._go_on(claim.block.index)

    def _go_on(self, index: int, *piece: StudySlice) -> None:
        """Let an attempt take a slice, up to its next one, or its end."""
        attempt = self._attempts[index]
        attempt.switch(*piece)
        if attempt.dead:
            del self._attempts[index]
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
