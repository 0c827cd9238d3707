"""Computing one claimed block: from claim to durable results, with checkpoints on the way."""

import errno
import logging
import os
import threading
import time
from collections.abc import Callable
from typing import Any, TypeVar

from jointplay.records.failure import InvalidInput
from jointplay.records.job import ErrorClass, JobError
from jointplay.records.log_lines import about
from jointplay.solver.kernels.watched import watched
from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import BlockEnd, BlockState, Claim, Verdict
from jointplay.storage.errors import ResultsError
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.execute import Answer, Outcome, Progress
from jointplay.worker.holding import Holding, Refused
from jointplay.worker.lease import Lease
from jointplay.worker.removal import tidy, withdraw
from jointplay.worker.transient_faults import TRANSIENT, waits_for
from jointplay.worker.work import Work, work_of

Answered = TypeVar("Answered")
_log = logging.getLogger(__name__)
_BLOCK_STATES = {
    "succeeded": BlockState.done,
    "failed": BlockState.failed,
    "cancelled": BlockState.cancelled,
}
_MOST_OVERHEAD = 20
"""Restart points are made so rarely that computing takes this many times their processor time."""
_MOST_WAITING = 4
"""The same of all the time that they take, most of which a slow disk or a busy machine may need:
readers are as far behind as restart points are apart."""
_LOOK = 0.25
"""Seconds after which the catalogue is asked again whether to go on."""
ASK_AGAIN = 1.0
"""Seconds after which a catalogue that did not answer is asked again, or another block begun."""
_LONG = 1.0
"""Seconds after which a block that has not advanced is said to be compiling."""


class BlockRun:
    """One attempt at a block by this process.

    Parameters
    ----------
    draining
        Set when this process shall end soon: the block is then checkpointed and given back.
    require_reachable
        Raises OSError while results cannot be stored. Asked before anything is computed, and again
        before the block ends: what was stored in place of a disk is not on it.
    advance
        That of whatever sends the block's files.
    """

    def __init__(
        self,
        catalogue: Holding,
        settings: Settings,
        claim: Claim,
        draining: threading.Event,
        require_reachable: Callable[[], None] = lambda: None,
        advance: Advance | None = None,
    ) -> None:
        self._catalogue = catalogue
        self._settings = settings
        self._claim = claim
        self._block = claim.block
        self._job = claim.job
        self._lease = Lease(catalogue, claim, settings, advance)
        self._draining = draining
        self._require_reachable = require_reachable
        self._next_record = time.monotonic() + settings.progress_period
        self._next_look = time.monotonic() + _LOOK
        self._reports = 0
        self._reached = (claim.block.progress_time, claim.block.progress_fraction)
        self._work: Work | None = None
        self._compiling = threading.Timer(_LONG, self._say_that_it_compiles)
        self._compiling.daemon = True

    def run(self) -> None:
        """Compute the block and tell the catalogue how it ended, waiting until it answers.

        A block that another worker has taken over is left alone without a word.

        Raises
        ------
        Refused
            The service does not take this worker any more; others take the block over.
        """
        with about(job=self._job.id, block=self._block.id, attempt=self._block.attempt):
            self._run()

    def _run(self) -> None:
        try:
            with self._lease:
                try:
                    outcome = self._compute()
                except TRANSIENT as fault:
                    _log.warning("block %s is put off: %s", self._block.id, fault)
                    self._insist(self._catalogue.put_off, waits_for(fault))
                    self._draining.wait(ASK_AGAIN)  # the next block would meet the same fault
                    return
                if outcome.state == "left":
                    self._insist(self._catalogue.release)
                    return
                state = self._insist(self._catalogue.finish, self._end(outcome))
        except Fenced as fenced:
            _log.warning("%s; leaving it", fenced)
            withdraw(self._catalogue, self._settings, self._block)
            return
        _log.info("block %s %s, job %s", self._block.id, outcome.state, state.value)
        if state.terminal:
            tidy(self._settings, self._block)

    def _end(self, outcome: Outcome) -> BlockEnd:
        return BlockEnd(
            _BLOCK_STATES[outcome.state],
            outcome.error,
            outcome.time,
            outcome.fraction,
            (outcome.statistics or {}).get("steps"),
            repeatable=outcome.state == "succeeded"
            and self._work is not None
            and self._work.recognised,
        )

    def _insist(self, operation: Callable[..., Answered], *given: Any) -> Answered:
        """Carry out an operation of the catalogue on the block, however long it takes.

        A process that shall end waits no longer than the lease: then the block is anybody's.
        """
        began = time.monotonic()
        while True:
            try:
                return operation(self._block.id, self._block.attempt, *given)
            except Unavailable as fault:
                if self._draining.is_set() and time.monotonic() - began > self._settings.lease:
                    raise
                _log.warning("block %s waits: %s", self._block.id, fault)
                self._lease.advanced()
                time.sleep(ASK_AGAIN)

    def _compute(self) -> Outcome:
        try:
            self._require_room()
            self._require_reachable()
            self._work = work_of(self._claim, self._settings)
            self._compiling.start()
            with watched(self._while_compiling, self._settings.longest_compilation):
                outcome = self._work.execute(self._report, self._lease.advanced)
            self._require_reachable()
            return outcome
        except (Fenced, Refused, *TRANSIENT):
            raise
        except InvalidInput as error:
            # admitted when it was submitted: this solver is stricter than that one
            return self._failed("user", "invalid-input", str(error))
        except ResultsError as error:
            _log.exception("block %s cannot be stored", self._block.id)
            return self._failed("platform", "storage", str(error))
        except Exception as error:  # noqa: BLE001 - a worker outlives whatever a job does
            _log.exception("block %s failed", self._block.id)
            return self._failed(
                "platform",
                "internal",
                f"an error of the program itself, not of the job: {type(error).__name__};"
                " the worker's log has the details",
            )
        finally:
            self._compiling.cancel()

    def _failed(self, error_class: ErrorClass, code: str, detail: str) -> Outcome:
        return Outcome("failed", *self._reached, JobError(error_class, code, detail))

    def _report(self, progress: Progress) -> Answer:
        """Between two slices: soon notice a request to stop; about once a second, record."""
        self._lease.advanced()
        self._reports += 1
        if self._reports == 2:  # one slice is done, so its kernel is there
            self._compiling.cancel()
        self._reached = (progress.time, progress.fraction)
        if self._draining.is_set():
            self._keep(progress)
            return Answer.leave
        self._require_room()  # several workers fill what is left for the catalogue in a second
        now = time.monotonic()
        try:
            if now >= self._next_record:
                rest = self._keep(progress)
                verdict = self._lease.record_progress(
                    progress.time, progress.fraction, progress.steps()
                )
                now = time.monotonic()
                self._next_record = now + max(self._settings.progress_period, rest)
            elif now >= self._next_look:
                verdict = self._lease.verdict()
            else:
                return Answer.go_on
        except TRANSIENT as fault:
            _log.warning("block %s goes on without a word: %s", self._block.id, fault)
            self._next_record = self._next_look = time.monotonic() + ASK_AGAIN
            return Answer.go_on
        self._next_look = now + _LOOK
        return Answer.go_on if verdict is Verdict.go_on else Answer.cancel

    def _while_compiling(self) -> Answer | None:
        """Say whether code that is being compiled is unwanted, and why; None while it is wanted."""
        self._lease.advanced()
        if self._draining.is_set():
            return Answer.leave
        now = time.monotonic()
        if now < self._next_look:
            return None
        self._next_look = now + _LOOK
        try:
            return None if self._lease.verdict() is Verdict.go_on else Answer.cancel
        except TRANSIENT as fault:
            _log.warning("block %s goes on without a word: %s", self._block.id, fault)
            self._next_look = now + ASK_AGAIN
            return None

    def _require_room(self) -> None:
        if self._settings.room() <= 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(self._settings.data))

    def _keep(self, progress: Progress) -> float:
        """Put a restart point on the disk, then name it in the catalogue.

        Return the seconds until there should be another one.
        """
        began, used = time.monotonic(), time.thread_time()
        name, watermark = progress.keep()
        self._catalogue.record_checkpoint(
            self._block.id, self._block.attempt, watermark=watermark, checkpoint=name
        )
        took, used = time.monotonic() - began, time.thread_time() - used
        return max(_MOST_OVERHEAD * used, _MOST_WAITING * took)

    def _say_that_it_compiles(self) -> None:
        try:
            self._catalogue.note_activity(self._block.id, self._block.attempt, "compiling")
        except (Fenced, Refused, Unavailable) as error:
            _log.debug("block %s compiles, which could not be noted: %s", self._block.id, error)
