"""Backend of a job: follows and cancels it, and leads to its results; here that of a service."""

from collections.abc import Iterator
from typing import Any, Protocol

from jointplay.client.connection import Connection, segment
from jointplay.client.events import follow
from jointplay.client.http_results import HttpResults
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Results


class Backend(Protocol):
    """Operations that a `Job` passes on."""

    def results(self, job: JobRecord) -> Results:
        """Return the way to its results."""

    def look(self, job: JobRecord) -> dict[str, Any]:
        """Return its document as it is now."""

    def follow(self, job: JobRecord, deadline: float | None) -> Iterator[None]:
        """Keep a job up to date until it is finished; yield whenever it has changed."""

    def cancel(self, job: JobRecord) -> dict[str, Any]:
        """Ask for it to be cancelled, and return its document."""

    def delete(self, job: JobRecord) -> None:
        """Delete it with its results."""


class ServiceBackend:
    """The service that a job was submitted to."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def results(self, job: JobRecord) -> HttpResults:
        """Return its results over HTTP."""
        return HttpResults(self._connection, job)

    def look(self, job: JobRecord) -> dict[str, Any]:
        """Return its document as the service has it now."""
        document: dict[str, Any] = self._connection.get(_path(job)).json()
        return document

    def follow(self, job: JobRecord, deadline: float | None) -> Iterator[None]:
        """Keep it up to date by its events."""
        yield from follow(self._connection, job, deadline)

    def cancel(self, job: JobRecord) -> dict[str, Any]:
        """Ask the service to cancel it."""
        document: dict[str, Any] = self._connection.post(f"{_path(job)}/cancel").json()
        return document

    def delete(self, job: JobRecord) -> None:
        """Delete it at the service."""
        self._connection.delete(_path(job))


def _path(job: JobRecord) -> str:
    return f"/v1/jobs/{segment(job.id)}"
