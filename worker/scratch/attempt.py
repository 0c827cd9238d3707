"""One attempt at a block whose files are sent to where others find them: see `worker.holding`."""

import logging
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from threading import Lock
from typing import NamedTuple

from jointplay.storage.attempt_files import STUDY
from jointplay.storage.catalogue.errors import CatalogueError, Unavailable
from jointplay.storage.catalogue.records import BlockEnd, JobState
from jointplay.worker.holding import Holding
from jointplay.worker.scratch.files import Scratch, Taken

_log = logging.getLogger(__name__)


class _RestartPoint(NamedTuple):
    """A restart point as it was made, to be sent and then named."""

    block: str
    attempt: int
    watermark: int
    name: str
    files: Taken


class SentAttempt:
    """Whoever keeps the catalogue, who hears of a restart point or an end once its files were sent.

    Computing goes on while a restart point is sent; of those that wait the newest one counts.
    """

    def __init__(self, catalogue: Holding, scratch: Scratch) -> None:
        self._catalogue = catalogue
        self._scratch = scratch
        self.get = catalogue.get
        self.verdict = catalogue.verdict
        self.heartbeat = catalogue.heartbeat
        self.record_progress = catalogue.record_progress
        self.note_activity = catalogue.note_activity
        self._sender = ThreadPoolExecutor(1, "restart points")
        self._turn = Lock()
        self._waiting: _RestartPoint | None = None

    @contextmanager
    def sending(self) -> Iterator[None]:
        """Send restart points while it lasts."""
        try:
            yield
        finally:
            self._await()

    def record_checkpoint(
        self, block_id: str, attempt: int, /, *, watermark: int, checkpoint: str
    ) -> None:
        """Have the restart point sent, and then named."""
        made = _RestartPoint(block_id, attempt, watermark, checkpoint, self._scratch.take())
        with self._turn:
            older, self._waiting = self._waiting, made
        if older is not None:
            older.files.opened.close()
        self._sender.submit(self._record)

    def _record(self) -> None:
        with self._turn:
            made, self._waiting = self._waiting, None
        if made is None:  # it was sent in the turn of an older one
            return
        try:
            self._scratch.send(made.files)
            self._catalogue.record_checkpoint(
                made.block, made.attempt, watermark=made.watermark, checkpoint=made.name
            )
        except (CatalogueError, OSError) as fault:  # the next one tries again
            _log.warning("block %s has no new restart point: %s", made.block, fault)

    def _await(self) -> None:
        """Return when the newest restart point was sent."""
        self._sender.shutdown()

    def release(self, block_id: str, attempt: int, /) -> None:
        """Give the block back with its newest restart point."""
        self._await()
        self._catalogue.release(block_id, attempt)

    def put_off(self, block_id: str, attempt: int, activity: str, /) -> None:
        """Give the block back, as `release` does."""
        self._await()
        self._catalogue.put_off(block_id, attempt, activity)

    def finish(self, block_id: str, attempt: int, end: BlockEnd, /) -> JobState:
        """Send what a block of a study computed, then end the block."""
        self._send_study()
        return self._catalogue.finish(block_id, attempt, end)

    def _send_study(self) -> None:
        """Send; what a run computed is sealed, where its results belong."""
        self._await()
        try:
            self._scratch.send(self._scratch.take(STUDY))
        except OSError as fault:  # the block waits until it has passed
            raise Unavailable(
                f"is told of no end before its results are stored: {fault}"
            ) from fault
