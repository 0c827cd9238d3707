"""The event stream of a job: how far it is, as soon as that changes, until it is finished."""

import random
import time
from collections.abc import Iterator, Mapping
from typing import Any

from jointplay.client.connection import Connection, segment
from jointplay.client.errors import ServiceFailure, Unreachable
from jointplay.client.job_record import JobRecord

_SILENCE = 45.0  # s without a word, where one comes every 15 s: the connection is lost
_PATIENCE = 20.0  # s for which a lost service is looked for again
_LONGEST_PAUSE = 2.0


def follow(connection: Connection, job: JobRecord, deadline: float | None) -> Iterator[None]:
    """Keep state and progress of a job up to date, and yield whenever they have changed.

    The iteration ends when the job is finished; what else its record says is as old as before.

    Parameters
    ----------
    connection
        To the service.
    job
        As it was last seen; updated in place.
    deadline
        Of `time.monotonic`, after which the iteration ends early; none: it does not.

    Raises
    ------
    Unreachable
        The service was lost and did not come back.
    """
    lost_since: float | None = None
    pause = 0.1
    while deadline is None or time.monotonic() < deadline:
        try:
            for snapshot in _snapshots(connection, job.id, deadline):
                lost_since, pause = None, 0.1
                if job.advance(snapshot):
                    yield
                if job.is_finished:
                    return
        except (Unreachable, ServiceFailure):
            now = time.monotonic()
            lost_since = lost_since or now
            if now - lost_since > _PATIENCE:
                raise
        # not all clients of a service that was lost come back in the same moment
        time.sleep(pause * random.uniform(0.5, 1.0))  # noqa: S311
        pause = min(2 * pause, _LONGEST_PAUSE)


def _snapshots(
    connection: Connection, job_id: str, deadline: float | None
) -> Iterator[Mapping[str, Any]]:
    """Yield the progress events of one connection."""
    silence = _SILENCE
    if deadline is not None:
        silence = min(silence, max(deadline - time.monotonic(), 0.01))
    try:
        for event in connection.events(f"/v1/jobs/{segment(job_id)}/events", silence):
            if deadline is not None and time.monotonic() > deadline:
                return
            if event.event == "progress":
                yield event.json()
    except Unreachable:
        if deadline is None or time.monotonic() < deadline:
            raise
