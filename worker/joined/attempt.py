"""One attempt at a block, of which the service keeps the books: see `worker.holding`."""

import time
from contextlib import suppress
from typing import Final

from jointplay.storage.catalogue.errors import CatalogueError, Fenced, Unavailable
from jointplay.storage.catalogue.records import BlockEnd, Claim, Job, JobState, Verdict
from jointplay.worker.holding import Refused
from jointplay.worker.joined import protocol
from jointplay.worker.joined.connection import Connection, answer_of
from jointplay.worker.scratch.files import Scratch
from jointplay.worker.spent import publishing

_PART_OF_LEASE: Final = 0.25
"""Part of the lease in which a block must be held longer: behind one address may be several APIs of
which one is gone, and there must be time to reach another one."""
_LATE: Final = 1.0
"""Seconds after which an answer is late: the service was out of reach."""


class JoinedAttempt:
    """Tells the service of the attempt; `SentAttempt` has sent the files that this is about.

    Computing never waits for a round trip: how far it is goes with the next restart point or
    heartbeat, and whether to go on is known from the last answer to one.
    """

    def __init__(self, connection: Connection, claim: Claim, scratch: Scratch) -> None:
        self._connection = connection
        self._claim = claim
        self._scratch = scratch
        self._progress: protocol.Progress | None = None
        """Reached, and not told yet."""
        self._verdict = Verdict.go_on
        self._end: Fenced | Refused | None = None
        self._cut_off = True
        """Whether the service was not reached when it was last told something; at first it has
        only answered a claim, maybe late."""

    def get(self, job: str, /) -> Job:
        """Return the job as it was claimed; the service itself removes what a late attempt left."""
        return self._claim.job

    def verdict(self, block_id: str, attempt: int, /) -> Verdict:
        """Return what the service answered last."""
        if self._end is not None:
            raise self._end
        return self._verdict

    def heartbeat(self, block_id: str, attempt: int, lease: float, /) -> Verdict:
        """Hold the block for the service's own lease, and tell how far it is if no one has."""
        within, progress = _PART_OF_LEASE * lease, self._progress
        if progress is not None:
            self._answered("progress", progress, within=within)
            self._note_reported(progress)
        return self._answered("heartbeat", None, within=within)

    def record_progress(
        self,
        block_id: str,
        attempt: int,
        lease: float,
        /,
        *,
        time: float,
        fraction: float,
        steps: int | None = None,
    ) -> Verdict:
        """Note how far the block is, which is told soon. Returns what the service answered last."""
        self._progress = protocol.Progress(time=time, fraction=fraction, steps=steps)
        return self.verdict(block_id, attempt)

    def record_checkpoint(
        self, block_id: str, attempt: int, /, *, watermark: int, checkpoint: str
    ) -> None:
        """Name a restart point, whose files were sent, and tell how far the block is."""
        progress = self._progress
        told = protocol.Checkpoint(watermark=watermark, checkpoint=checkpoint, progress=progress)
        self._answered("checkpoint", told)
        self._note_reported(progress)

    def note_activity(self, block_id: str, attempt: int, activity: str, /) -> None:
        """Tell what takes long."""
        self._report("activity", protocol.Activity(activity=activity))

    def release(self, block_id: str, attempt: int, /) -> None:
        """Give the block back."""
        self._report("release")

    def put_off(self, block_id: str, attempt: int, activity: str, /) -> None:
        """Give the block back until a fault has passed."""
        self._report("put-off", protocol.Activity(activity=activity))

    def finish(self, block_id: str, attempt: int, end: BlockEnd, /) -> JobState:
        """Send sealed results, then end the block."""
        with publishing(jobs=0.0):  # whose packing was counted
            self._scratch.send_sealed()
        answer = self._report("finish", protocol.Finish(**vars(end)))
        return answer_of(protocol.Finished, answer).state

    def _note_reported(self, progress: protocol.Progress | None) -> None:
        if self._progress is progress:  # else the block has come further meanwhile
            self._progress = None

    def _answered(
        self, what: str, document: protocol.Document | None, *, within: float | None = None
    ) -> Verdict:
        """Tell something from whatever thread, and note the answer for the one that computes."""
        try:
            content = self._report(what, document, within=within)
        except (Fenced, Refused) as end:
            self._end = end
            raise
        self._verdict = answer_of(protocol.Answered, content).verdict
        return self._verdict

    def _report(
        self, what: str, document: protocol.Document | None = None, *, within: float | None = None
    ) -> bytes:
        """Tell something; of a block that was lost while the service was out of reach also that."""
        begun = time.monotonic()
        try:
            content = self._connection.report(self._claim.block, what, document, within=within)
        except Unavailable:
            self._cut_off = True
            raise
        except Fenced:
            self._cut_off |= time.monotonic() - begun > _LATE
            self.report_if_cut_off()
            raise
        self._cut_off = False
        return content

    def report_if_cut_off(self) -> None:
        """Tell of a block that was lost, if the service was out of reach meanwhile."""
        if self._cut_off:
            with suppress(CatalogueError):
                self._connection.report(self._claim.block, "cut-off")
