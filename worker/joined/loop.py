"""Claiming and computing blocks, one after the other, until there are no more or time is over."""

import logging
import random
import tempfile
import threading
import time
from importlib.metadata import version
from pathlib import Path
from typing import Final

from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.settings import Settings
from jointplay.worker.block_run import BlockRun
from jointplay.worker.joined.attempt import JoinedAttempt
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.files import FilesOfService
from jointplay.worker.joined.protocol import Activity, Claimed, ClaimRequest
from jointplay.worker.own_solver import own_solver
from jointplay.worker.passing import waits_for
from jointplay.worker.presence import own_name
from jointplay.worker.scratch.attempt import SentAttempt
from jointplay.worker.scratch.files import Scratch
from jointplay.worker.spent import Telling

_WAIT: Final = 5.0  # s, for a block, until it is looked whether to go on
_FIRST_PAUSE, _LONGEST_PAUSE = 0.5, _WAIT
"""Seconds before a service that is away is asked again: as often as by those who have no work."""
_log = logging.getLogger(__name__)


def work(connection: Connection, draining: threading.Event, idle: float | None) -> int:
    """Compute blocks until `draining` is set, or there was none for `idle` seconds; count them.

    Raises
    ------
    Refused
        The service does not take this worker.
    """
    solver = own_solver()
    request = ClaimRequest(
        program=version("jointplay"),
        worker=own_name(),
        version=solver.version,
        processor=solver.processor,
        wait=_WAIT if idle is None else min(_WAIT, idle),
    )
    bucket = BucketOfService(connection)
    telling = Telling()
    last = time.monotonic()
    pause = _FIRST_PAUSE
    blocks = 0
    while not draining.is_set() and (idle is None or time.monotonic() - last <= idle):
        try:
            spent = telling.untold()
            claimed = connection.claim(request.model_copy(update={"spent": spent}))
            telling.told(spent)
            if claimed is not None:
                _compute(connection, bucket, claimed, draining)
                blocks += 1
                last = time.monotonic()
            pause = _FIRST_PAUSE
        except Fenced as fenced:
            _log.warning("%s; leaving it", fenced)
        except Unavailable as fault:
            _log.warning("asking again: %s", fault)
            draining.wait(pause * random.uniform(0.5, 1.0))  # noqa: S311 - not all at once
            pause = min(2 * pause, _LONGEST_PAUSE)
    return blocks


def _compute(
    connection: Connection, bucket: BucketOfService, claimed: Claimed, draining: threading.Event
) -> None:
    """Compute a block; where this machine has no room for its files, put it off."""
    try:
        _compute_here(connection, bucket, claimed, draining)
    except OSError as fault:
        block = claimed.claim.block
        _log.warning("block %s is put off: %s", block.id, fault)
        connection.tell(block, "put-off", Activity(activity=waits_for(fault)))


def _compute_here(
    connection: Connection, bucket: BucketOfService, claimed: Claimed, draining: threading.Event
) -> None:
    claim = claimed.claim
    with tempfile.TemporaryDirectory(prefix="jointplay-") as folder:
        settings = Settings(
            data=Path(folder),
            catalogue_url="",
            results_url="",
            running="data",
            redis_url=None,
            **claimed.customs.model_dump(),
        )
        scratch = Scratch(FilesOfService(connection, bucket, claim.block), settings, claim.block)
        attempt = JoinedAttempt(connection, claim, scratch)
        next_beat = time.monotonic() + settings.heartbeat

        def beat() -> None:
            nonlocal next_beat
            if time.monotonic() > next_beat:
                attempt.heartbeat(claim.block.id, claim.block.attempt, settings.lease)
                next_beat = time.monotonic() + settings.heartbeat

        try:
            scratch.fetch(beat)
        except Fenced:  # lost before it began: the claim was answered late
            attempt.tell_if_cut_off()
            raise
        sent = SentAttempt(attempt, scratch)
        with scratch.sending_rows(), sent.sending():
            BlockRun(sent, settings, claim, draining).run()
