"""`Client`: jobs, batches and scenes of one service."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import UTC, datetime
from functools import partial
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, Self

import httpx

from jointplay import jobs as documents
from jointplay.client.batches import Batch, counted_from, every_job, jobs_of
from jointplay.client.connection import LONGEST_ANSWER, Connection, segment
from jointplay.client.errors import ClientError, Refused
from jointplay.client.job import Job
from jointplay.client.job_record import Estimate
from jointplay.client.network import BlockingNetwork
from jointplay.client.service_job import ServiceJob
from jointplay.scene_choice import Scene, scene_document, with_parameters

MOST_JOBS = 10_000
"""Jobs that the service takes in one batch."""
Given = ParamSpec("Given")


def _submitting(
    describe: Callable[Given, dict[str, Any]],
) -> Callable[Concatenate["Client", Given], Job]:
    """Make a method that submits what `describe` describes."""

    def submit(self: "Client", /, *args: Given.args, **kwargs: Given.kwargs) -> Job:
        return self.submit(describe(*args, **kwargs))

    described = signature(describe)
    own = Parameter("self", Parameter.POSITIONAL_OR_KEYWORD)
    described_method: Any = submit  # for those who ask with help() or a question mark
    described_method.__name__, described_method.__doc__ = describe.__name__, describe.__doc__
    described_method.__signature__ = described.replace(
        parameters=[own, *described.parameters.values()], return_annotation=Job
    )
    return submit


class Client:
    """A connection to one service.

    ``client.simulate("seven-bar-press", clearance=5e-4, duration=2)`` submits a job and returns
    it at once; `bifurcation`, `sweep`, `poincare`, `ensemble` and `accuracy_study` likewise, as
    `jointplay.jobs` describes them.  A job that equals one that is queued, running or succeeded is
    not computed again: that one is returned, and ``cached``, unless ``cache=False`` is given.

    Requests are repeated when the service asks for it (429, 503) or the connection was lost; none
    has its effect twice.

    Parameters
    ----------
    url
        Address of the service; default the variable JOINTPLAY_URL, else this machine.
    key
        Key of the service, where it asks for one, or of a proxy before it: sent with each request
        as a bearer token; default the variable JOINTPLAY_KEY.
    timeout
        Longest wait for one answer, s.
    transport
        Another httpx transport, for example one that speaks to an application in process.
    """

    def __init__(
        self,
        url: str | None = None,
        *,
        key: str | None = None,
        timeout: float = LONGEST_ANSWER,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        network = partial(BlockingNetwork, transport=transport)
        self._connection = Connection(url, key, timeout, network)

    @classmethod
    def _over(cls, connection: Connection) -> Self:
        """Return a client of a connection that is there."""
        client = cls.__new__(cls)
        client._connection = connection
        return client

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Client({self._connection.url!r})"

    def close(self) -> None:
        """Close the connection."""
        self._connection.network.close()

    if TYPE_CHECKING:  # a method of each kind, see below

        def __getattr__(self, kind: str) -> Callable[..., Job]: ...

    def submit(self, document: Mapping[str, Any], *, idempotency_key: str | None = None) -> Job:
        """Queue a job that is given as a document; `Refused` names every field that is wrong.

        Parameters
        ----------
        document
            The job, as `jointplay.jobs` makes them or docs/http.md describes them.
        idempotency_key
            Sent again with the same job, also by another process, it finds what the first request
            made; by default every call has its own.
        """
        answer = self._connection.post("/v1/jobs", dict(document), idempotency_key)
        return ServiceJob(answer, self._connection)

    def map(self, jobs: Iterable[Mapping[str, Any]], *, label: str = "") -> Iterator[Job]:
        """Queue many jobs at once, and yield each when it and those before it are finished.

        The order is that of the documents.  Jobs that failed are yielded, too: look at ``state``
        or call `Job.check`.  More than 10 000 jobs are several batches.

        All or none: if a document is wrong, nothing of its batch is queued and the batches before
        it, which workers may have begun, are cancelled.

        Parameters
        ----------
        jobs
            Documents, as `jointplay.jobs` makes them.
        label
            A name for the batch.

        Raises
        ------
        Refused
            Documents are wrong: `fields` names them by their index among all of these.
        Expired
            While it yields: the next job has expired, or was deleted, before it was looked at.
        """
        given = list(jobs)
        queued: list[Mapping[str, Any]] = []
        try:
            for first in range(0, len(given), MOST_JOBS):
                queued.append(self._queue(given[first : first + MOST_JOBS], label))
        except ClientError as error:
            for batch in queued:
                with suppress(ClientError):
                    Batch(batch, self._connection).cancel()
            if isinstance(error, Refused):
                error.fields = counted_from(first, error.fields)
            raise
        found = (job for batch in queued for job in every_job(self._connection, batch))
        return (job.wait(check=False) for job in found)

    def submit_batch(self, jobs: Sequence[Mapping[str, Any]], label: str = "") -> Batch:
        """Queue many jobs, or none; `Refused` names every field that is wrong, by index."""
        return Batch(self._queue(jobs, label), self._connection)

    def _queue(self, jobs: Sequence[Mapping[str, Any]], label: str) -> Mapping[str, Any]:
        body = {"jobs": [dict(document) for document in jobs], "label": label}
        return self._connection.post("/v1/batches", body)

    def estimate(self, document: Mapping[str, Any]) -> Estimate:
        """Return what a job will cost; nothing is queued."""
        return Estimate.from_document(self._connection.post("/v1/estimates", dict(document)))

    def job(self, job_id: str) -> Job:
        """Return a job by its id, as it is now."""
        found = self._connection.get(f"/v1/jobs/{segment(job_id)}")
        return ServiceJob(found, self._connection)

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
        yield from jobs_of(self._connection, "/v1/jobs", chosen | window)

    def batch(self, batch_id: str) -> Batch:
        """Return a batch by its id, as it is now."""
        found = self._connection.get(f"/v1/batches/{segment(batch_id)}")
        return Batch(found, self._connection)

    def batches(self) -> Iterator[Batch]:
        """Yield batches, newest first, fetching pages as they are needed."""
        token: str | None = None
        while True:
            page = self._connection.get("/v1/batches", {"page_token": token})
            for found in page["batches"]:
                yield Batch(found, self._connection)
            token = page["next_page_token"]
            if token is None:
                return

    def check_scene(self, /, scene: Scene, **parameters: Any) -> dict[str, Any]:
        """Return whether a scene can be put together and move; ``problems`` say why not."""
        chosen = with_parameters(scene_document(scene), parameters)
        return self._connection.post("/v1/scenes/check", chosen)

    def poses(
        self, /, scene: Scene, *, times: Iterable[float] = (0.0,), **parameters: Any
    ) -> dict[str, Any]:
        """Return how a scene stands at t = 0 and as its drivers go on, its clearances closed.

        Parameters
        ----------
        scene
            Name of a preset, a scene document, or the path of one.
        times
            Instants, s, the earliest first; at most 512.
        parameters
            Parameters of the scene, in SI units.

        Returns
        -------
        dict
            ``poses``: for each of ``times``, by body, x, y (m) and theta (rad). Both end where the
            drivers cannot go on; ``stopped`` says when and why, and is None otherwise.
            ``drivers_time``: in which the drivers come round, s. ``curves``: of the joints that are
            drawn by any, such as outlines of cams, (n, 2) m from a point in its body's axes.
        """
        asked = {"times": [float(time) for time in times]}
        return self._about("poses", scene, parameters, asked)

    def drag(
        self,
        /,
        scene: Scene,
        point: str,
        position: Sequence[float],
        *,
        pose: Mapping[str, Sequence[float]] | None = None,
        **parameters: Any,
    ) -> dict[str, list[float]]:
        """Return the pose in which a point is as near to a position as the joints let it come.

        Drivers let go, and clearances are closed.

        Parameters
        ----------
        scene
            Name of a preset, a scene document, or the path of one.
        point
            What is pulled, such as ``"crank.pin"``.
        position
            To where, x and y, m.
        pose
            From where: x, y (m) and theta (rad) of every body, as a pose of `poses` or of this
            method; that at t = 0 if it is not given.
        parameters
            Parameters of the scene, in SI units.
        """
        asked: dict[str, Any] = {"point": point, "position": [float(value) for value in position]}
        if pose is not None:
            asked["pose"] = {body: [float(value) for value in at] for body, at in pose.items()}
        found: dict[str, list[float]] = self._about("drag", scene, parameters, asked)["pose"]
        return found

    def _about(
        self, what: str, scene: Scene, parameters: Mapping[str, Any], asked: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Return what the service answers to a question about a scene."""
        chosen = with_parameters(scene_document(scene), parameters)
        return self._connection.post(f"/v1/scenes/{what}", {"scene": chosen, **asked})

    def scenes(self) -> list[dict[str, Any]]:
        """Return the presets: name, description, source and parameters of each."""
        scenes: list[dict[str, Any]] = self._connection.get("/v1/scenes")["scenes"]
        return scenes

    def scene(self, name: str) -> dict[str, Any]:
        """Return the scene document of a preset."""
        return self._connection.get(f"/v1/scenes/{segment(name)}")

    def laws(self) -> list[dict[str, Any]]:
        """Return the laws that a scene can name: formula, parameters, source, where each fails."""
        found: list[dict[str, Any]] = self._connection.get("/v1/laws")["laws"]
        return found


def _text(moment: datetime | None) -> str | None:
    """Return a moment as the service takes it; one without a zone is this machine's."""
    return None if moment is None else moment.astimezone(UTC).isoformat()


for _name, _describe in documents.functions().items():
    setattr(Client, _name, _submitting(_describe))
