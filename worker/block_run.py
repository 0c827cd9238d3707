"""Computing one claimed block: from claim to sealed results, with checkpoints on the way."""

import logging
import shutil
import threading
import time
from pathlib import Path

from solver.admission import admit
from solver.errors import InvalidInput
from solver.version import SOLVER_VERSION
from storage.catalogue import (
    BlockState,
    Catalogue,
    Claim,
    ErrorClass,
    Fenced,
    JobError,
    Verdict,
)
from storage.results import ResultsError
from storage.results.layout import MANIFEST
from storage.settings import Settings
from worker import checkpoints
from worker.execute import Answer, Outcome, Progress, RestartPoint, execute
from worker.lease import Lease

_log = logging.getLogger(__name__)
_BLOCK_STATES = {
    "succeeded": BlockState.done,
    "failed": BlockState.failed,
    "cancelled": BlockState.cancelled,
}


class BlockRun:
    """One attempt at a block by this process.

    Parameters
    ----------
    draining
        Set when this process shall end soon: the block is then checkpointed and given back.
    """

    def __init__(
        self, catalogue: Catalogue, settings: Settings, claim: Claim, draining: threading.Event
    ) -> None:
        self._catalogue = catalogue
        self._settings = settings
        self._block = claim.block
        self._job = claim.job
        self._lease = Lease(catalogue, claim, settings)
        self._draining = draining
        self._folder = settings.result_folder(claim.job.id, claim.block.attempt)
        self._recorded = time.monotonic()
        self._reached = (claim.block.progress_time, claim.block.progress_fraction)

    def run(self) -> None:
        """Compute the block and tell the catalogue how it ended.

        A block that turns out to be somebody else's is left alone without a word.
        """
        try:
            with self._lease:
                outcome = self._compute()
                if outcome.state == "left":
                    self._catalogue.release(self._block.id, self._block.attempt)
                    return
                state = self._catalogue.finish(
                    self._block.id,
                    self._block.attempt,
                    _BLOCK_STATES[outcome.state],
                    outcome.error,
                    time=outcome.time,
                    fraction=outcome.fraction,
                )
        except Fenced as fenced:
            _log.warning("%s; leaving it", fenced)
            return
        _log.info("job %s %s", self._job.id, state.value)
        if state.terminal and (self._folder / MANIFEST).exists():
            self._sweep()

    def _compute(self) -> Outcome:
        try:
            return execute(
                admit(self._job.spec),
                self._folder,
                report=self._report,
                restart=self._restart_point(),
            )
        except Fenced:
            raise
        except InvalidInput as error:
            # admitted when it was submitted: this solver is stricter than that one
            return self._failed("user", "invalid-input", str(error))
        except OSError as error:
            _log.exception("block %s cannot be stored", self._block.id)
            return self._failed("platform", "storage", f"the results cannot be written: {error}")
        except ResultsError as error:
            _log.exception("block %s cannot be stored", self._block.id)
            return self._failed("platform", "storage", str(error))
        except Exception as error:  # noqa: BLE001 - a worker outlives whatever a job does
            _log.exception("block %s failed", self._block.id)
            return self._failed(
                "platform",
                "internal",
                f"an error of the program itself, not of the job: {type(error).__name__}:"
                f" {error}; the worker's log has the details",
            )

    def _failed(self, error_class: ErrorClass, code: str, detail: str) -> Outcome:
        return Outcome("failed", *self._reached, JobError(error_class, code, detail))

    def _report(self, progress: Progress) -> Answer:
        """Between two slices: notice a request to stop; about once a second, record."""
        self._lease.advanced()
        self._reached = (progress.time, progress.fraction)
        if self._draining.is_set():
            self._store(progress.restart_point())
            return Answer.leave
        now = time.monotonic()
        if now - self._recorded < self._settings.progress_period:
            verdict = self._lease.verdict()
        else:
            self._recorded = now
            self._store(progress.restart_point())
            verdict = self._lease.record_progress(progress.time, progress.fraction)
        return Answer.go_on if verdict is Verdict.go_on else Answer.cancel

    def _store(self, point: RestartPoint) -> None:
        """Put a restart point on the disk, then name it in the catalogue."""
        path = self._checkpoint_folder / f"block{self._block.index}-a{self._block.attempt}"
        checkpoints.store(path, point, SOLVER_VERSION)
        self._catalogue.record_checkpoint(
            self._block.id,
            self._block.attempt,
            watermark=point.watermark,
            checkpoint=path.name,
        )

    def _restart_point(self) -> RestartPoint | None:
        if self._block.checkpoint is None:
            return None
        try:
            return checkpoints.load(
                self._checkpoint_folder / self._block.checkpoint, SOLVER_VERSION
            )
        except checkpoints.UnusableRestartPoint as error:
            _log.warning("block %s begins anew: %s", self._block.id, error)
            return None

    @property
    def _checkpoint_folder(self) -> Path:
        return self._folder.parent

    def _sweep(self) -> None:
        """Remove earlier attempts and checkpoints: the job's results are in this folder."""
        for path in self._checkpoint_folder.iterdir():
            if path == self._folder:
                continue
            if path.is_dir():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)
