"""A job whose results are in a folder, as the same object that a client has."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.client.job import Job
from jointplay.client.job_record import JobRecord
from jointplay.local.folder import job_document

if TYPE_CHECKING:
    from jointplay.local.folder_results import FolderResults


class FolderBackend:
    """Backend of a job in a folder, which has ended."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def results(self, job: JobRecord) -> "FolderResults":
        """Return the results in the folder."""
        from jointplay.local.folder_results import FolderResults

        return FolderResults(self._folder)

    def look(self, job: JobRecord) -> dict[str, Any]:
        """Return the job as its folder describes it."""
        return job_document(self._folder)

    def follow(self, job: JobRecord, deadline: float | None) -> Iterator[None]:
        """Yield nothing: it is finished."""
        yield from ()

    def cancel(self, job: JobRecord) -> dict[str, Any]:
        """Change nothing: it is finished."""
        return self.look(job)

    def delete(self, job: JobRecord) -> None:
        """Remove the folder."""
        shutil.rmtree(self._folder)


def load(folder: Path | str) -> Job:
    """Return the job whose results `run`, or the command ``jointplay run``, left in a folder.

    Raises
    ------
    jointplay.client.NotFound
        There are none.
    """
    path = Path(folder)
    return Job(job_document(path), FolderBackend(path))
