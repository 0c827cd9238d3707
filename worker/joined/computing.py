"""Blocks of a service that this worker joined: each in a folder of its own, sent as it grows."""

import logging
import tempfile
import threading
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.block_run import BlockRun
from jointplay.worker.joined.attempt import JoinedAttempt
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.files import FilesOfService
from jointplay.worker.joined.protocol import Activity, Customs
from jointplay.worker.own_solver import own_solver
from jointplay.worker.scratch.attempt import SentAttempt
from jointplay.worker.scratch.files import Scratch
from jointplay.worker.transient_faults import waits_for

_log = logging.getLogger(__name__)


class JoinedBlocks:
    """Claims and computes them by questions to the service; see `device_run.Blocks`."""

    def __init__(
        self,
        connection: Connection,
        bucket: BucketOfService,
        customs: Customs,
        draining: threading.Event,
    ) -> None:
        self._connection, self._bucket = connection, bucket
        self._customs, self._draining = customs, draining

    def beside(self, claim: Claim, most: int) -> Sequence[Claim]:
        """Claim further blocks of a claim's study."""
        try:
            return self._connection.claim_beside(claim.block, own_solver(), most)
        except (Fenced, Unavailable) as fault:
            _log.warning("none is claimed beside block %s: %s", claim.block.id, fault)
            return ()

    def compute(self, claim: Claim, advance: Advance | None = None) -> None:
        """Compute a block; where this machine has no room for its files, put it off.

        Raises
        ------
        CatalogueError
            The block is another worker's, or the service is out of reach or refuses this worker.
        """
        try:
            self._compute(claim, advance or Advance())
        except OSError as fault:
            block = claim.block
            _log.warning("block %s is put off: %s", block.id, fault)
            self._connection.report(block, "put-off", Activity(activity=waits_for(fault)))

    def _compute(self, claim: Claim, advance: Advance) -> None:
        block = claim.block
        with tempfile.TemporaryDirectory(prefix="jointplay-") as folder:
            settings = Settings(
                data=Path(folder),
                catalogue_url="",
                results_url="",
                running="data",
                redis_url=None,
                **self._customs.model_dump(),
            )
            files = FilesOfService(self._connection, self._bucket, block)
            scratch = Scratch(files, settings, block, advance)
            attempt = JoinedAttempt(self._connection, claim, scratch)
            beat = partial(attempt.heartbeat, block.id, block.attempt, settings.lease)
            try:
                scratch.fetch(beat)
            except Fenced:  # lost before it began: the claim was answered late
                attempt.report_if_cut_off()
                raise
            sent = SentAttempt(attempt, scratch)
            with scratch.sending_rows(), sent.sending():
                BlockRun(sent, settings, claim, self._draining, advance=advance).run()
