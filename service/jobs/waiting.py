"""Waiting for jobs: one look at the catalogue for everybody, and answers that are held back.

A request is held back by ``?wait=30`` or ``Prefer: wait=10``.
"""

import asyncio
import logging
import re
from collections import defaultdict
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from typing import Annotated

from fastapi import Depends, Header, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel, ConfigDict

from jointplay.service.dependencies import of_the_application
from jointplay.service.fields import in_unit
from jointplay.service.owners import SHARES
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Job, JobStatus

LONGEST_WAIT = 60  # s; a client that wants to wait longer asks again
_PREFERRED = re.compile(r"""(?:^|[,;])\s*wait\s*=\s*"?(\d{1,9})"?\s*(?=[,;]|$)""", re.IGNORECASE)
_PERIOD = 0.01
"""Seconds between two looks when a wait begins; growing to ..."""
_LONGEST_PERIOD = 0.1
_GROWTH = 1.04  # so that this takes seconds: most jobs that are waited for are short, and what
# looks often at one that is not takes a tenth of a core from those who compute it
_AT_ONCE = 500  # jobs in one question to the database
_log = logging.getLogger(__name__)


class Watch:
    """One client's view of one job; made by `Watcher.watching`."""

    def __init__(self) -> None:
        self.latest: JobStatus | None = None
        self._changed = asyncio.Event()

    def show(self, status: JobStatus) -> None:
        """Note what the job looks like now."""
        self.latest = status
        self._changed.set()

    async def change(self, seconds: float) -> JobStatus | None:
        """Return the job once it has changed, at first as it is; none after so many seconds."""
        try:
            await asyncio.wait_for(self._changed.wait(), seconds)
        except TimeoutError:
            return None
        self._changed.clear()
        return self.latest

    async def changes(self, quiet: float) -> AsyncIterator[JobStatus | None]:
        """Yield the job whenever it has changed, at first as it is, and none after `quiet` s."""
        while True:
            yield await self.change(quiet)


class Watcher:
    """Looks at all watched jobs together: a thousand waiting clients cost one question."""

    def __init__(self, catalogue: Catalogue) -> None:
        self._catalogue = catalogue
        self._watches: dict[str, set[Watch]] = defaultdict(set)
        self._looking: asyncio.Task[None] | None = None
        self._woken = asyncio.Event()

    @contextmanager
    def watching(self, job_id: str) -> Iterator[Watch]:
        """Watch a job while the block runs."""
        watch = Watch()
        self._watches[job_id].add(watch)
        self._woken.set()
        if self._looking is None or self._looking.done():
            self._looking = asyncio.create_task(self._look())
        try:
            yield watch
        finally:
            self._watches[job_id].discard(watch)
            if not self._watches[job_id]:
                del self._watches[job_id]

    async def finished(self, job_id: str, seconds: float) -> bool:
        """Wait until a job is finished, at most for `seconds`. Returns whether it is."""
        # no timeout around that of `change`: where a change comes as it ends, `wait_for` of Python
        # 3.11 swallows the cancellation, which does not come again
        loop = asyncio.get_running_loop()
        until = loop.time() + seconds
        with self.watching(job_id) as watch:
            while (left := until - loop.time()) > 0:
                status = await watch.change(left)
                if status is not None and status.state.terminal:
                    return True
        return False

    async def _look(self) -> None:
        """Look until no one watches; what a database that fails hides is seen later."""
        pause = _PERIOD
        while self._watches:
            self._woken.clear()
            try:
                self._show(await self._statuses(list(self._watches)))
            except Unavailable as error:
                _log.warning("looking again: %s", error)
            pause = min(_GROWTH * pause, _LONGEST_PERIOD)
            try:
                await asyncio.wait_for(self._woken.wait(), pause)
                pause = _PERIOD
            except TimeoutError:
                pass

    async def _statuses(self, jobs: list[str]) -> list[JobStatus]:
        found: list[JobStatus] = []
        for first in range(0, len(jobs), _AT_ONCE):
            some = jobs[first : first + _AT_ONCE]
            found += await run_in_threadpool(self._catalogue.statuses, some)
        return found

    def _show(self, statuses: list[JobStatus]) -> None:
        for status in statuses:
            for watch in self._watches.get(status.job, ()):
                if watch.latest != status:
                    watch.show(status)


class WaitQuery(BaseModel):
    """Time to wait for the end of a job."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)

    wait: float = in_unit(
        "s",
        "Answer when the job is finished, at the latest after this time.",
        default=0.0,
        ge=0.0,
        le=LONGEST_WAIT,
    )


class Patience:
    """Time for which this request may be held back, and the means to do so."""

    def __init__(self, request: Request, response: Response, prefer: str | None) -> None:
        self._request, self._response = request, response
        wanted = _PREFERRED.search(prefer or "")
        self._preferred = None if wanted is None else min(int(wanted[1]), LONGEST_WAIT)

    async def finished(self, job: Job, wait: float = 0.0) -> Job:
        """Return the job as soon as it is finished, or as it is when the time is over.

        Where too many of an owner wait, a preference is not honoured, and `wait` refused with 429.
        """
        seconds = max(wait, self._preferred or 0)
        waits = bool(seconds) and not job.state.terminal
        if waits and wait:
            SHARES.must_wait(self._request.scope)
        elif waits and not SHARES.wait(self._request.scope):
            return job
        if self._preferred is not None:  # RFC 7240: tell that the preference was honoured
            self._response.headers["Preference-Applied"] = f"wait={self._preferred}"
        if not waits:
            return job
        application = self._request.app.state
        await application.watcher.finished(job.id, seconds)
        found: Job = await run_in_threadpool(application.catalogue.get, job.id)
        return found


WatcherDependency = Annotated[Watcher, of_the_application("watcher")]


async def _patience(
    request: Request,
    response: Response,
    prefer: Annotated[
        str | None,
        Header(
            description="`wait=10` (RFC 7240) holds the answer back until the job is finished, at "
            "most for that time."
        ),
    ] = None,
) -> Patience:
    return Patience(request, response, prefer)


PatienceDependency = Annotated[Patience, Depends(_patience)]
