"""`Client`: the resources of the service as methods."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any, Self

import httpx

from jointplay.client.connection import DEFAULT_URL, Connection, segment
from jointplay.client.errors import ClientError
from jointplay.client.jobs import Job
from jointplay.client.results import History, Impacts, Peak, Section
from jointplay.client.windows import pieces

_SHORTEST_PAUSE = 0.05  # s between two questions in `wait`, growing to ...
_LONGEST_PAUSE = 1.0  # ... this, so that a long job costs one request a second


class Client:
    """A connection to one service.

    Parameters
    ----------
    url
        Address of the service.
    timeout
        Longest wait for one answer, s.
    transport
        Another httpx transport, for example one that speaks to an application in process.
    """

    def __init__(
        self,
        url: str = DEFAULT_URL,
        *,
        timeout: float = 60.0,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        self._connection = Connection(url, timeout, transport)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Client({self._connection.url!r})"

    def close(self) -> None:
        """Close the connection."""
        self._connection.close()

    def submit(self, document: Mapping[str, Any]) -> Job:
        """Queue a job; `Refused` names every field that is wrong."""
        return _job(self._connection.post("/v1/jobs", dict(document)))

    def get(self, job_id: str) -> Job:
        """Return the job as it is now."""
        return _job(self._connection.get(f"/v1/jobs/{segment(job_id)}"))

    def cancel(self, job_id: str) -> Job:
        """Ask for the job to be cancelled; asking again, or too late, changes nothing."""
        return _job(self._connection.post(f"/v1/jobs/{segment(job_id)}/cancel"))

    def jobs(self) -> Iterator[Job]:
        """Yield all jobs, newest first, fetching pages as they are needed."""
        token: str | None = None
        while True:
            query = {"page_token": token}
            page = self._connection.get("/v1/jobs", query).json()
            for document in page["jobs"]:
                yield Job.from_document(document)
            token = page["next_page_token"]
            if token is None:
                return

    def wait(
        self,
        job_id: str,
        report: Callable[[Job], None] | None = None,
        timeout: float | None = None,
    ) -> Job:
        """Ask until the job is finished, and return it, whether it succeeded or not.

        Parameters
        ----------
        job_id
            The job.
        report
            Called with the job after every question, for a progress bar.
        timeout
            Longest wait, s; then `ClientError`.  The job goes on.
        """
        deadline = None if timeout is None else time.monotonic() + timeout
        pause = _SHORTEST_PAUSE
        while True:
            job = self.get(job_id)
            if report is not None:
                report(job)
            if job.is_finished:
                return job
            if deadline is not None and time.monotonic() + pause > deadline:
                raise ClientError(f"Job {job_id} is still {job.state} after {timeout:g} s.")
            time.sleep(pause)
            pause = min(pause * 1.3, _LONGEST_PAUSE)

    def history(
        self,
        job_id: str,
        channels: Sequence[str] | None = None,
        start: float | None = None,
        stop: float | None = None,
    ) -> History:
        """Return channels (names or globs; all if None) from ``start`` to ``stop``, in s.

        What is too large for one answer of the service is fetched in several.
        """
        found = self._windows(job_id, "history", start, stop, channels=_joined(channels))
        return History.joined([History.from_document(document) for document in found])

    def poincare(
        self,
        job_id: str,
        channels: Sequence[str] | None = None,
        start: float | None = None,
        stop: float | None = None,
    ) -> Section:
        """Return channels at the Poincare sections from ``start`` to ``stop``, in s."""
        found = self._windows(job_id, "poincare", start, stop, channels=_joined(channels))
        return Section.joined([Section.from_document(document) for document in found])

    def peaks(self, job_id: str) -> dict[str, Peak]:
        """Return the signed extremes of every channel."""
        document = self._result(job_id, "peaks")
        return {name: Peak.from_document(peak) for name, peak in document["peaks"].items()}

    def statistics(self, job_id: str) -> dict[str, Any]:
        """Return what the run cost, and its energy ledger with the residual, in J."""
        return self._result(job_id, "statistics")

    def impacts(
        self, job_id: str, start: float | None = None, stop: float | None = None
    ) -> Impacts:
        """Return the contacts of the clearance joints that begin from ``start`` to ``stop``."""
        found = self._windows(job_id, "impacts", start, stop)
        rows = [row for document in found for row in document["impacts"]]
        if len(found) > 1:  # windows are of onsets
            rows.sort(key=lambda row: math.inf if row["release"] is None else row["release"])
        return Impacts.from_rows(rows)

    def figures(self, job_id: str) -> list[str]:
        """Return the names of the figures that can be drawn of the job's results."""
        return [figure["name"] for figure in self._result(job_id, "figures")["figures"]]

    def figure(self, job_id: str, name: str, form: str = "png") -> bytes:
        """Return a figure as a file's bytes; ``form`` is "png" or "svg"."""
        path = f"/v1/jobs/{segment(job_id)}/figures/{segment(name)}.{segment(form)}"
        return self._connection.get(path).content

    def scenes(self) -> list[dict[str, Any]]:
        """Return the presets: name, description, source and parameters of each."""
        scenes: list[dict[str, Any]] = self._connection.get("/v1/scenes").json()["scenes"]
        return scenes

    def scene(self, name: str) -> dict[str, Any]:
        """Return the scene document of a preset."""
        document: dict[str, Any] = self._connection.get(f"/v1/scenes/{segment(name)}").json()
        return document

    def _windows(
        self, job_id: str, name: str, start: float | None, stop: float | None, **query: Any
    ) -> list[dict[str, Any]]:
        def fetch(start: float | None, stop: float | None) -> dict[str, Any]:
            return self._result(job_id, name, {**query, "start": start, "stop": stop})

        def end() -> float:
            return float(self.get(job_id).job["duration"])

        return list(pieces(fetch, start, stop, end))

    def _result(
        self, job_id: str, name: str, query: Mapping[str, Any] | None = None
    ) -> dict[str, Any]:
        path = f"/v1/jobs/{segment(job_id)}/{name}"
        document: dict[str, Any] = self._connection.get(path, query).json()
        return document


def _job(response: httpx.Response) -> Job:
    return Job.from_document(response.json())


def _joined(channels: Sequence[str] | None) -> str | None:
    return None if channels is None else ",".join(channels)
