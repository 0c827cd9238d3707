"""Holding an answer back until a job is finished: ``?wait=30`` and ``Prefer: wait=10``."""

import re
from typing import Annotated

from fastapi import Depends, Header, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel, ConfigDict, Field

from jointplay.service.dependencies import CatalogueDependency
from jointplay.service.jobs.watcher import Watcher
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job

LONGEST_WAIT = 60  # s; a client that wants to wait longer asks again
_PREFERRED = re.compile(r"""(?:^|[,;])\s*wait\s*=\s*"?(\d{1,9})"?\s*(?=[,;]|$)""", re.IGNORECASE)


class WaitQuery(BaseModel):
    """Time to wait for the end of a job."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)

    wait: float = Field(
        default=0.0,
        ge=0.0,
        le=LONGEST_WAIT,
        description="Answer when the job is finished, at the latest after this time.",
        json_schema_extra={"unit": "s"},
    )


class Patience:
    """Time for which this request may be held back, and the means to do so."""

    def __init__(
        self, watcher: Watcher, catalogue: Catalogue, response: Response, prefer: str | None
    ) -> None:
        self._watcher, self._catalogue = watcher, catalogue
        self._response = response
        wanted = _PREFERRED.search(prefer or "")
        self._preferred = None if wanted is None else min(int(wanted[1]), LONGEST_WAIT)

    async def finished(self, job: Job, wait: float = 0.0) -> Job:
        """Return the job as soon as it is finished, or as it is when the time is over."""
        if self._preferred is not None:  # RFC 7240: tell that the preference was honoured
            self._response.headers["Preference-Applied"] = f"wait={self._preferred}"
        seconds = max(wait, self._preferred or 0)
        if job.state.terminal or not seconds:
            return job
        await self._watcher.finished(job.id, seconds)
        return await run_in_threadpool(self._catalogue.get, job.id)


async def watcher_of(request: Request) -> Watcher:
    """Return the application's watcher."""
    watcher: Watcher = request.app.state.watcher
    return watcher


WatcherDependency = Annotated[Watcher, Depends(watcher_of)]


async def _patience(
    watcher: WatcherDependency,
    catalogue: CatalogueDependency,
    response: Response,
    prefer: Annotated[
        str | None,
        Header(
            description="`wait=10` (RFC 7240) holds the answer back until the job is finished, at "
            "most for that time."
        ),
    ] = None,
) -> Patience:
    return Patience(watcher, catalogue, response, prefer)


PatienceDependency = Annotated[Patience, Depends(_patience)]
