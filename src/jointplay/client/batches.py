"""Jobs that were submitted together."""

import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, Self

from jointplay.client import service_job
from jointplay.client.batch_record import BatchRecord, read_batch
from jointplay.client.connection import Connection, segment
from jointplay.client.errors import FieldProblem, ServiceFailure, TimedOut, Unreachable
from jointplay.client.job import Job
from jointplay.client.service_job import ServiceJob

_INDEX = re.compile(r"^/jobs/(\d+)")
_SHORTEST_PAUSE = 0.05  # s between two questions, growing to ...
_LONGEST_PAUSE = 1.0  # ... this, so that a long batch costs one request a second ...
_LATE = 0.05  # ... and no answer comes later than by this part of the time it took


class Batch(BatchRecord):
    """A batch of a service; what is known of it changes with `refresh`, `cancel` and `wait`."""

    def __init__(self, document: Mapping[str, Any], connection: Connection) -> None:
        super().__init__(**read_batch(document))
        self._connection = connection
        self._path = f"/v1/batches/{segment(self.id)}"

    def refresh(self) -> Self:
        """Look at the batch once more."""
        self.renew(self._connection.get(self._path))
        return self

    def jobs(self) -> Iterator[Job]:
        """Yield the jobs in the order in which they were given, page by page as they are needed."""
        yield from jobs_of(self._connection, f"{self._path}/jobs")

    def cancel(self) -> Self:
        """Ask for every job that is not finished to be cancelled."""
        self.renew(self._connection.post(f"{self._path}/cancel"))
        return self

    def retry(self) -> Self:
        """Queue those jobs anew that failed or were cancelled, as a batch of their own.

        Asked again it is the same batch. `Refused` if there is none to retry.
        """
        return type(self)(self._connection.post(f"{self._path}/retry"), self._connection)

    def delete(self) -> None:
        """Delete the batch with all its jobs and results; `NotFinished` before all have ended."""
        self._connection.delete(self._path)

    def wait(
        self, *, report: Callable[[Self], None] | None = None, timeout: float | None = None
    ) -> Self:
        """Ask until every job is finished, whether it succeeded or not.

        A service that is away is asked again for as long as one that loses a job's events.

        Parameters
        ----------
        report
            Called with the batch after every answer.
        timeout
            Longest wait, s; then `TimedOut`.
        """
        begin = heard = time.monotonic()
        while True:
            try:
                self.refresh()
            except (Unreachable, ServiceFailure):
                if time.monotonic() - heard > service_job.PATIENCE:
                    raise
            else:
                heard = time.monotonic()
                if report is not None:
                    report(self)
                if self.is_finished:
                    return self
            waited = time.monotonic() - begin
            pause = min(max(_LATE * waited, _SHORTEST_PAUSE), _LONGEST_PAUSE)
            if timeout is not None and waited + pause > timeout:
                raise TimedOut(f"Batch {self.id} is at {self.fraction:.0%} after {timeout:g} s.")
            self._connection.network.sleep(pause)


def jobs_of(
    connection: Connection, path: str, query: Mapping[str, str | None] | None = None
) -> Iterator[Job]:
    """Yield the jobs of a list, fetching pages as they are needed."""
    token: str | None = None
    while True:
        page = connection.get(path, {**(query or {}), "page_token": token})
        for document in page["jobs"]:
            yield ServiceJob(document, connection)
        token = page["next_page_token"]
        if token is None:
            return


def every_job(connection: Connection, queued: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the jobs of a batch, by what the service answered when it was queued; all or `Expired`.

    Lists leave out jobs that have expired or were deleted.
    """
    listed = jobs_of(connection, f"/v1/batches/{segment(queued['id'])}/jobs")
    following = next(listed, None)
    for job_id in queued["job_ids"]:
        if following is not None and following.id == job_id:
            yield following
            following = next(listed, None)
        else:
            yield ServiceJob(connection.get(f"/v1/jobs/{segment(job_id)}"), connection)


def counted_from(first: int, problems: Iterable[FieldProblem]) -> tuple[FieldProblem, ...]:
    """Name refused fields of a batch whose jobs are counted from `first`."""

    def counted(found: re.Match[str]) -> str:
        return f"/jobs/{first + int(found[1])}"

    return tuple(FieldProblem(_INDEX.sub(counted, pointer), detail) for pointer, detail in problems)
