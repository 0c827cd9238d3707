"""`Client`: the resources of the service as methods."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from functools import partial
from types import TracebackType
from typing import Any, Self

import httpx

from jointplay.client import studies
from jointplay.client.batches import Batch
from jointplay.client.connection import DEFAULT_URL, Connection, segment
from jointplay.client.errors import ClientError
from jointplay.client.estimates import Estimate
from jointplay.client.events import follow
from jointplay.client.jobs import Job
from jointplay.client.results import History, Impacts, Peak, Section
from jointplay.client.waiting import wait_for
from jointplay.client.windows import pieces
from jointplay.study_dataset import StudyDataset


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

    def submit(self, document: Mapping[str, Any], *, key: str | None = None) -> Job:
        """Queue a job; `Refused` names every field that is wrong.

        A job that equals one that is queued, running or succeeded is not computed again: that one
        is returned, and ``cached``, unless the document says ``"cache": False``.

        Parameters
        ----------
        document
            The job.
        key
            Idempotency key: sent again with the same job it finds what the first request made.
        """
        headers = {} if key is None else {"Idempotency-Key": key}
        return _job(self._connection.post("/v1/jobs", dict(document), headers))

    def estimate(self, document: Mapping[str, Any]) -> Estimate:
        """Return what a job will cost; nothing is queued."""
        answer = self._connection.post("/v1/estimates", dict(document)).json()
        return Estimate.from_document(answer)

    def delete(self, job_id: str) -> None:
        """Delete a finished job and its results."""
        self._connection.delete(f"/v1/jobs/{segment(job_id)}")

    def get(self, job_id: str) -> Job:
        """Return the job as it is now."""
        return _job(self._connection.get(f"/v1/jobs/{segment(job_id)}"))

    def cancel(self, job_id: str) -> Job:
        """Ask for the job to be cancelled; asking again, or too late, changes nothing."""
        return _job(self._connection.post(f"/v1/jobs/{segment(job_id)}/cancel"))

    def jobs(
        self,
        *,
        state: str | None = None,
        kind: str | None = None,
        label: str | None = None,
        scene: str | None = None,
        since: datetime | None = None,
        before: datetime | None = None,
    ) -> Iterator[Job]:
        """Yield jobs, newest first, fetching pages as they are needed.

        Parameters
        ----------
        state, kind, label, scene
            Only jobs with these; a scene by the name of its preset or its own.
        since, before
            Only jobs submitted in this time, the end not included.
        """
        window = {"since": _text(since), "before": _text(before)}
        chosen = {"state": state, "kind": kind, "label": label, "scene": scene}
        yield from self._job_pages("/v1/jobs", chosen | window)

    def _job_pages(self, path: str, chosen: Mapping[str, str | None] = {}) -> Iterator[Job]:
        token: str | None = None
        while True:
            page = self._connection.get(path, {**chosen, "page_token": token}).json()
            for document in page["jobs"]:
                yield Job.from_document(document)
            token = page["next_page_token"]
            if token is None:
                return

    def submit_batch(self, documents: Sequence[Mapping[str, Any]], label: str = "") -> Batch:
        """Queue many jobs, or none; `Refused` names every field that is wrong, by index."""
        body = {"jobs": [dict(document) for document in documents], "label": label}
        return Batch.from_document(self._connection.post("/v1/batches", body).json())

    def batch(self, batch_id: str) -> Batch:
        """Return a batch as it is now."""
        found = self._connection.get(f"/v1/batches/{segment(batch_id)}")
        return Batch.from_document(found.json())

    def batch_jobs(self, batch_id: str) -> Iterator[Job]:
        """Yield the jobs of a batch, last submitted first, fetching pages as they are needed."""
        yield from self._job_pages(f"/v1/batches/{segment(batch_id)}/jobs")

    def cancel_batch(self, batch_id: str) -> Batch:
        """Ask for every job of a batch that is not finished to be cancelled."""
        answer = self._connection.post(f"/v1/batches/{segment(batch_id)}/cancel")
        return Batch.from_document(answer.json())

    def wait_batch(
        self,
        batch_id: str,
        report: Callable[[Batch], None] | None = None,
        timeout: float | None = None,
    ) -> Batch:
        """Ask until every job of the batch is finished; as `wait`."""
        return wait_for(
            partial(self.batch, batch_id),
            report,
            timeout,
            lambda batch: f"Batch {batch_id} is at {batch.fraction:.0%}",
        )

    def wait(
        self,
        job_id: str,
        report: Callable[[Job], None] | None = None,
        timeout: float | None = None,
    ) -> Job:
        """Follow the job until it is finished, and return it, whether it succeeded or not.

        Parameters
        ----------
        job_id
            The job.
        report
            Called with the job whenever it has changed, for a progress bar.
        timeout
            Longest wait, s; then `ClientError`.  The job goes on.
        """
        deadline = None if timeout is None else time.monotonic() + timeout
        job = self.get(job_id)
        if report is not None:
            report(job)
        if job.is_finished:
            return job
        for seen in follow(self._connection, job, deadline):
            job = seen
            if report is not None and not job.is_finished:
                report(job)
        if not job.is_finished:
            raise ClientError(f"Job {job_id} is still {job.state} after {timeout} s.")
        job = self.get(job_id)
        if report is not None:
            report(job)
        return job

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

    def study(
        self,
        job_id: str,
        observables: Sequence[str] | None = None,
        channels: Sequence[str] | None = None,
        sections: tuple[int, int] | None = None,
    ) -> StudyDataset:
        """Return the points of a study as they are now; it need not be finished.

        Parameters
        ----------
        job_id
            A job of any kind but simulate.
        observables
            Names or globs of channels whose values at the sections to fetch; all if None.
        channels
            Of a sweep, names or globs of channels whose extremes to fetch; all if None.
        sections
            First section of each point, and the one before which to end; all if None.
        """
        job = self.get(job_id)
        if "sweep" in job.links:
            chosen = {"channel": _joined(channels)}
            return studies.with_extremes(job, partial(self._query, job_id, "sweep", **chosen))
        if job.kind == "simulate":
            raise ClientError(f"Job {job_id} is a simulation; it has a history and no points.")
        chosen = {"channels": _joined(observables)}
        window = sections or (0, int(job.job["record"]))
        fetch = partial(self._query, job_id, "poincare", **chosen)
        return studies.with_sections(job, fetch, window)

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

    def figure(self, job_id: str, name: str, form: str = "png", **selection: Any) -> bytes:
        """Return a figure as a file's bytes.

        Parameters
        ----------
        job_id, name
            The job, and a figure of it or one of its channels.
        form
            "png" or "svg".
        selection
            ``channels`` and ``joints`` (lists of names), ``start`` and ``stop``: a window of time
            in s; of a study the first point, and the one before which to end.
        """
        path = f"/v1/jobs/{segment(job_id)}/figures/{segment(name)}.{segment(form)}"
        query = {
            key: ",".join(value) if isinstance(value, list | tuple) else value
            for key, value in selection.items()
        }
        return self._connection.get(path, query).content

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

    def _query(self, job_id: str, name: str, **query: Any) -> dict[str, Any]:
        return self._result(job_id, name, query)

    def _result(
        self, job_id: str, name: str, query: Mapping[str, Any] | None = None
    ) -> dict[str, Any]:
        path = f"/v1/jobs/{segment(job_id)}/{name}"
        document: dict[str, Any] = self._connection.get(path, query).json()
        return document


def _text(moment: datetime | None) -> str | None:
    """Return a moment as the service takes it; one without a zone is this machine's."""
    return None if moment is None else moment.astimezone(UTC).isoformat()


def _job(response: httpx.Response) -> Job:
    return Job.from_document(response.json())


def _joined(channels: Sequence[str] | None) -> str | None:
    return None if channels is None else ",".join(channels)
