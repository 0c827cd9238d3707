"""Computing a claimed block where the files of running jobs are: here, or elsewhere."""

import logging
import tempfile
import threading
from functools import partial
from pathlib import Path

from jointplay.records.log_lines import about
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.installation import require_reachable
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.block_run import ASK_AGAIN, BlockRun
from jointplay.worker.removal import withdraw
from jointplay.worker.scratch.attempt import SentAttempt
from jointplay.worker.scratch.files import Scratch
from jointplay.worker.transient_faults import TRANSIENT, waits_for

_log = logging.getLogger(__name__)


def compute(
    catalogue: Catalogue,
    settings: Settings,
    claim: Claim,
    draining: threading.Event,
    advance: Advance | None = None,
) -> None:
    """Compute a block, and tell the catalogue how it ended; see `BlockRun`.

    `advance` : that of all blocks that are computed together, if several are.
    """
    advance = advance or Advance()
    if settings.sends:
        with tempfile.TemporaryDirectory(prefix="jointplay-") as folder:
            _compute_in(Path(folder), catalogue, settings, claim, draining, advance)
    else:
        there = partial(require_reachable, settings, catalogue)
        BlockRun(catalogue, settings, claim, draining, there, advance).run()


def _compute_in(
    folder: Path,
    catalogue: Catalogue,
    settings: Settings,
    claim: Claim,
    draining: threading.Event,
    advance: Advance,
) -> None:
    block = claim.block
    here = settings.model_copy(update={"data": folder, "running": "data"})
    scratch = Scratch(AttemptFiles(settings, block), here, block, advance)
    there = partial(require_reachable, settings, catalogue)
    beat = partial(catalogue.heartbeat, block.id, block.attempt, settings.lease)
    with about(job=block.job, block=block.id, attempt=block.attempt):
        try:
            scratch.fetch(beat)
        except Fenced as fenced:
            _log.warning("%s; leaving it", fenced)
            return
        except TRANSIENT as fault:
            _log.warning("block %s is put off: %s", block.id, fault)
            _put_off(catalogue, claim, waits_for(fault))
            draining.wait(ASK_AGAIN)
            return
        attempt = SentAttempt(catalogue, scratch)
        with scratch.sending_rows(), attempt.sending():
            BlockRun(attempt, here, claim, draining, there, advance).run()
        if scratch.used:
            withdraw(catalogue, settings, block)


def _put_off(catalogue: Catalogue, claim: Claim, activity: str) -> None:
    """Give a block back that was not begun; if that cannot be, its lease will end."""
    try:
        catalogue.put_off(claim.block.id, claim.block.attempt, activity)
    except TRANSIENT as fault:
        _log.warning("block %s is not given back: %s", claim.block.id, fault)
