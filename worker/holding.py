"""Questions of a worker about a block that it holds, to whoever keeps the catalogue."""

from typing import Protocol

from jointplay.storage.catalogue.errors import CatalogueError
from jointplay.storage.catalogue.records import BlockEnd, Job, JobState, Verdict


class Refused(CatalogueError):
    """The service does not take this worker, or not any more; the sentence says why."""


class Holding(Protocol):
    """The catalogue itself, or a service that is asked over HTTP.

    The methods are those of `storage.catalogue.catalogue.Catalogue`, and raise what they raise:
    `Fenced` where the attempt does not hold the block, `Unavailable` for what may pass; a service
    may raise `Refused`, too, as when the worker's key is revoked.
    """

    def get(self, job: str, /) -> Job:
        """Return the job."""
        ...

    def verdict(self, block_id: str, attempt: int, /) -> Verdict:
        """Return whether to go on."""
        ...

    def heartbeat(self, block_id: str, attempt: int, lease: float, /) -> Verdict:
        """Hold the block `lease` seconds longer."""
        ...

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
        """Tell how far the block is, and hold it longer."""
        ...

    def record_checkpoint(
        self, block_id: str, attempt: int, /, *, watermark: int, checkpoint: str
    ) -> None:
        """Name a restart point."""
        ...

    def note_activity(self, block_id: str, attempt: int, activity: str, /) -> None:
        """Tell what takes long."""
        ...

    def release(self, block_id: str, attempt: int, /) -> None:
        """Give the block back."""
        ...

    def put_off(self, block_id: str, attempt: int, activity: str, /) -> None:
        """Give the block back until a fault has passed."""
        ...

    def finish(self, block_id: str, attempt: int, end: BlockEnd, /) -> JobState:
        """End the block, and return the state of its job."""
        ...
