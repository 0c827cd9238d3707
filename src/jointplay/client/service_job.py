"""A job of a service: followed by its events, cancelled and deleted over HTTP."""

import random
import time
from collections.abc import Iterator, Mapping
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

from jointplay.client.connection import Connection, document_in, segment
from jointplay.client.errors import Overloaded, ServiceFailure, Unreachable
from jointplay.client.http_results import HttpResults
from jointplay.client.job import Job
from jointplay.client.results import Store

if TYPE_CHECKING:
    import xarray as xr

_SILENCE = 45.0  # s without a word, where one comes every 15 s: the connection is lost
PATIENCE = 20.0  # s for which a lost service is looked for again
_FIRST_PAUSE, _LONGEST_PAUSE = 0.1, 2.0
_BETWEEN_LOOKS = 10.0  # s at most, of a job of whose events the service streams no more


class ServiceJob(Job):
    """A `Job` of the service that a connection leads to."""

    def __init__(self, document: Mapping[str, Any], connection: Connection) -> None:
        super().__init__(document)
        self._connection = connection
        self._path = f"/v1/jobs/{segment(self.id)}"

    def retry(self) -> Job:
        """Queue it once more, as `Job.retry` says."""
        return type(self)(self._connection.post(f"{self._path}/retry"), self._connection)

    def report_mismatch(self) -> None:
        """Note that a repetition gave other results; it is the answer to no submission any more."""
        self._connection.post(f"{self._path}/report-mismatch")

    def delete(self) -> None:
        """Delete the finished job with its results; there is no way back."""
        self._connection.delete(self._path)

    def _open_results(self) -> HttpResults:
        return HttpResults(self._connection, self._path, self)

    def _open(self, store: Store, group: str) -> "xr.Dataset":
        return self._connection.network.call(partial(super()._open, store, group))

    def _look(self) -> dict[str, Any]:
        return self._connection.get(self._path)

    def _ask_to_end(self) -> dict[str, Any]:
        return self._connection.post(f"{self._path}/cancel")

    def _follow(self, deadline: float | None) -> Iterator[None]:
        """Follow the events, over as many connections as it takes; look at it while there is none.

        An owner who has as many streams as a service gives one waits for any number of jobs so.
        """
        lost_since: float | None = None
        pause = _FIRST_PAUSE
        while deadline is None or time.monotonic() < deadline:
            try:
                for streamed, snapshot in self._news(deadline):
                    lost_since = None
                    pause = _FIRST_PAUSE if streamed else pause
                    if self.advance(snapshot):
                        yield
                    if self.is_finished:
                        return
            except (Unreachable, ServiceFailure):
                now = time.monotonic()
                lost_since = lost_since or now
                if now - lost_since > PATIENCE:
                    raise
            # not all clients of a service that was lost come back in the same moment
            left = inf if deadline is None else max(deadline - time.monotonic(), 0.0)
            spread = pause * random.uniform(0.5, 1.0)  # noqa: S311
            self._connection.network.sleep(min(spread, left))
            pause = min(2 * pause, _LONGEST_PAUSE if lost_since else _BETWEEN_LOOKS)

    def _news(self, deadline: float | None) -> Iterator[tuple[bool, Mapping[str, Any]]]:
        """Yield what there is to know, and whether it is from a stream: else none was free."""
        try:
            for snapshot in self._snapshots(deadline):
                yield True, snapshot
        except Overloaded:
            yield False, self._look()

    def _snapshots(self, deadline: float | None) -> Iterator[Mapping[str, Any]]:
        """Yield the progress events of one connection."""
        silence = _SILENCE
        if deadline is not None:
            silence = min(silence, max(deadline - time.monotonic(), 0.01))
        try:
            for event in self._connection.events(f"{self._path}/events", silence):
                if deadline is not None and time.monotonic() > deadline:
                    return
                if event.event == "progress":
                    yield document_in(event.data, self._connection.url)
        except Unreachable:
            if deadline is None or time.monotonic() < deadline:
                raise
