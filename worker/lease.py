"""Holding a claimed block: heartbeats from a thread, also while kernels are being compiled."""

import logging
import os
import signal
import threading
from contextvars import copy_context
from functools import partial
from typing import Self

from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import Claim, Verdict
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.holding import Holding, Refused

_log = logging.getLogger(__name__)


class Lease:
    """Keeps a claimed block's lease alive while it is entered.

    If nothing advances for `settings.stall` seconds the process kills itself: a computation
    that does not return cannot be ended in any other way, and its block is then taken over.

    Parameters
    ----------
    advance
        That of whatever sends the block's files; where nothing does, one of its own.
    """

    def __init__(
        self,
        catalogue: Holding,
        claim: Claim,
        settings: Settings,
        advance: Advance | None = None,
    ) -> None:
        self._catalogue = catalogue
        self._block, self._attempt = claim.block.id, claim.block.attempt
        self._settings = settings
        self._ended = threading.Event()
        self._fenced = threading.Event()
        self._advance = advance or Advance()
        self.advanced = self._advance.note
        """Notes that the computation moved on."""

    def __enter__(self) -> Self:
        self.advanced()
        beat = partial(copy_context().run, self._beat)  # its lines are about the block, too
        self._thread = threading.Thread(target=beat, name="heartbeat", daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()

    def verdict(self) -> Verdict:
        """Return whether to go on, reading only; Fenced if another worker has the block."""
        self._refuse_when_fenced()
        return self._catalogue.verdict(self._block, self._attempt)

    def record_progress(
        self, simulated: float, fraction: float, steps: int | None = None
    ) -> Verdict:
        """Store progress and extend the lease; Fenced if another worker has the block."""
        self._refuse_when_fenced()
        return self._catalogue.record_progress(
            self._block,
            self._attempt,
            self._settings.lease,
            time=simulated,
            fraction=fraction,
            steps=steps,
        )

    def _refuse_when_fenced(self) -> None:
        if self._fenced.is_set():
            raise Fenced(self._block, self._attempt)

    def _beat(self) -> None:
        while not self._ended.wait(self._settings.heartbeat):
            if self._advance.age() > self._settings.stall:
                _log.critical("block %s has not advanced; ending this process", self._block)
                os.kill(os.getpid(), signal.SIGKILL)
            try:
                self._catalogue.heartbeat(self._block, self._attempt, self._settings.lease)
            except Fenced:
                self._fenced.set()
                return
            except Refused as refused:  # which the next report hears, too, and ends the block
                _log.debug("no more heartbeats of block %s: %s", self._block, refused)
                return
            except Unavailable as error:
                # it may be back before the lease runs out
                _log.warning("heartbeat of block %s failed: %s", self._block, error)
            except Exception:  # noqa: BLE001 - without heartbeats the block would be lost
                _log.exception("heartbeat of block %s failed", self._block)
