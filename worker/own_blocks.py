"""Blocks of a service of whose machines this is one."""

import logging
import threading
from collections.abc import Sequence

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.beside import claim_beside
from jointplay.worker.own_solver import own_solver
from jointplay.worker.scratch.computing import compute

_log = logging.getLogger(__name__)


class OwnBlocks:
    """Claims and computes them by the catalogue; see `device_run.Blocks`."""

    def __init__(self, catalogue: Catalogue, settings: Settings, draining: threading.Event) -> None:
        self._catalogue, self._settings, self._draining = catalogue, settings, draining

    def beside(self, claim: Claim, most: int) -> Sequence[Claim]:
        """Claim further blocks of a claim's study."""
        try:
            return claim_beside(self._catalogue, self._settings, claim.block, own_solver(), most)
        except Unavailable as fault:
            _log.warning("none is claimed beside block %s: %s", claim.block.id, fault)
            return ()

    def compute(self, claim: Claim, advance: Advance | None = None) -> None:
        """Compute a block, and tell the catalogue how it ended."""
        compute(self._catalogue, self._settings, claim, self._draining, advance)
