"""One attempt at a block whose files go to the place for results: see `worker.holding`."""

from typing import Any

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import BlockState, JobState
from jointplay.worker.scratch.files import STUDY, Scratch


class SentAttempt:
    """The catalogue, which hears of a restart point or an end once its files were sent."""

    def __init__(self, catalogue: Catalogue, scratch: Scratch) -> None:
        self._catalogue = catalogue
        self._scratch = scratch
        self.get = catalogue.get
        self.verdict = catalogue.verdict
        self.heartbeat = catalogue.heartbeat
        self.record_progress = catalogue.record_progress
        self.note_activity = catalogue.note_activity
        self.release = catalogue.release
        self.put_off = catalogue.put_off

    def record_checkpoint(
        self, block_id: str, attempt: int, /, *, watermark: int, checkpoint: str
    ) -> None:
        """Send what the restart point is made of, then name it."""
        self._scratch.send()
        self._catalogue.record_checkpoint(
            block_id, attempt, watermark=watermark, checkpoint=checkpoint
        )

    def finish(
        self,
        block_id: str,
        attempt: int,
        outcome: BlockState,
        error: JobError | None = None,
        /,
        **reached: Any,
    ) -> JobState:
        """Send what a block of a study computed, then end the block."""
        self._send_study()
        return self._catalogue.finish(block_id, attempt, outcome, error, **reached)

    def finish_repeatable(
        self,
        block_id: str,
        attempt: int,
        outcome: BlockState,
        error: JobError | None = None,
        /,
        **reached: Any,
    ) -> JobState:
        """End a block that is quickly found to have ended."""
        self._send_study()
        return self._catalogue.finish_repeatable(block_id, attempt, outcome, error, **reached)

    def _send_study(self) -> None:
        """Send; what a run computed is sealed, where its results belong."""
        try:
            self._scratch.send(STUDY)
        except OSError as fault:  # the block waits until it has passed
            raise Unavailable(
                f"is told of no end before its results are stored: {fault}"
            ) from fault
