"""Times until the blocks that were held when a fault struck go on."""

import time
from collections.abc import Callable

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Block, BlockState, JobState

PATIENCE = 180.0
"""Seconds after which a block that does not go on is given up; no fault's trace lasts so long."""
_LOOK = 0.1  # s


class Recovery:
    """Blocks that were held at one moment, and how long they wait for the platform afterwards.

    Parameters
    ----------
    workers
        How many blocks are computed at a time. What waits because all workers have others
        does not wait for the platform.
    of
        Which of the blocks that are held.
    """

    def __init__(
        self, catalogue: Catalogue, workers: int, of: Callable[[Block], bool] = lambda _: True
    ) -> None:
        self._catalogue = catalogue
        self._workers = workers
        self.held: dict[str, Block] = {}
        self.held = {block.id: block for block in self._blocks() if _runs(block) and of(block)}

    def wait(self, since: float) -> float | None:
        """Wait until every block advances, has ended or is claimed again.

        Parameters
        ----------
        since
            When the fault was over, on the monotonic clock.

        Returns
        -------
        float or None
            Seconds that the last one waited; none if one never went on.
        """
        waited = dict.fromkeys(self.held, 0.0)
        waiting = dict(self.held)
        standing: dict[str, Block] = {}
        before = since
        while waiting and max(waited.values()) < PATIENCE:
            time.sleep(_LOOK)
            blocks = {block.id: block for block in self._blocks()}
            busy = sum(_runs(block) for block in blocks.values()) >= self._workers
            now = time.monotonic()
            for name in [*waiting]:
                block = blocks.get(name)
                if block is None:
                    continue
                if not (busy and block.state is BlockState.queued):
                    waited[name] += now - before
                if _goes_on(self.held[name], standing.setdefault(name, block), block):
                    del waiting[name]
            before = now
        return None if waiting else max(waited.values(), default=0.0)

    def _blocks(self) -> list[Block]:
        """Return the blocks of jobs that run, and those held; none while there is no answer.

        No file of the catalogue stays open, because a power cut takes its files away.
        """
        try:
            jobs = self._catalogue.jobs(limit=1000).jobs
            looked_at = {block.job for block in self.held.values()}
            looked_at |= {job.id for job in jobs if job.state is JobState.running}
            return [block for job in looked_at for block in self._catalogue.blocks(job)]
        except Unavailable:
            return []
        finally:
            self._catalogue.close()


def _runs(block: Block) -> bool:
    return block.state is BlockState.running


def _goes_on(held: Block, before: Block, now: Block) -> bool:
    if not _runs(now):
        return now.state is not BlockState.queued
    return now.attempt > held.attempt or now.progress_fraction > before.progress_fraction
