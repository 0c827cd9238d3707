"""``/v1/jobs/{id}/events``: what happens to a job, as server-sent events."""

import asyncio
import logging
from collections.abc import AsyncIterator, Awaitable, Callable
from functools import partial
from typing import Annotated, Any

from fastapi import APIRouter, Header, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.sse import EventSourceResponse, format_sse_event
from pydantic import BaseModel, Field

from jointplay.service.access import CallerDependency
from jointplay.service.dependencies import CatalogueDependency, JobOfThePath
from jointplay.service.jobs.schemas import Progress, moment
from jointplay.service.jobs.waiting import Watcher, WatcherDependency
from jointplay.service.owners import SHARES
from jointplay.service.problems import kinds, problems
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Event, Job, JobState

_PAGE = 1000
_QUIET = 15.0
"""Seconds after which a comment is sent: proxies cut connections that say nothing."""
_COME_BACK = 1000  # ms after which a browser connects anew
_LOOK_AGAIN = 1.0  # s
_log = logging.getLogger(__name__)

_FIELDS: dict[str, Any] = {
    "type": "object",
    "description": "The fields of each event.",
    "properties": {
        "event": {"type": "string", "description": "Its type: progress, or one of the history."},
        "id": {"type": "string", "description": "Its number in the history; progress has none."},
        "data": {"type": "string", "description": "JSON: JobProgress, or JobEvent."},
    },
    "required": ["event", "data"],
}

router = APIRouter(prefix="/v1/jobs", tags=["jobs"])
STREAM: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "Events until the job is finished.",
        "content": {EventSourceResponse.media_type: {"schema": _FIELDS}},
    },
    204: {"description": "The job is finished, and the client has all its events."},
}


class JobEvent(BaseModel):
    """One thing that happened to a job; its number is the id of the event in the stream."""

    seq: int = Field(description="Counts from 1 without gaps.")
    type: str = Field(
        description=(
            "A state of the job, or claimed, compiling, released, put-off, lost, refused, retried."
        )
    )
    time: str = Field(description="When it happened, RFC 3339 in UTC.")
    data: dict[str, Any] = Field(
        description="What belongs to it: block, attempt, worker, error, job, retry_of."
    )


class JobProgress(BaseModel):
    """Progress of a job now; these events have no number, and only the newest matters."""

    state: JobState
    activity: str | None
    attempt: int
    progress: Progress


@router.get(
    "/{job_id}/events",
    response_class=Response,
    responses=STREAM | problems(*kinds.OF_A_JOB, kinds.INVALID_REQUEST),
)
async def show_events(
    request: Request,
    caller: CallerDependency,
    job: JobOfThePath,
    catalogue: CatalogueDependency,
    watcher: WatcherDependency,
    last_event_id: Annotated[
        int,
        Header(
            alias="Last-Event-ID",
            ge=0,
            le=2**31 - 1,
            description="The number of the last event that was received.",
        ),
    ] = 0,
) -> Response:
    """Stream what happens to a job, and how far it is, until it is finished.

    Events carry their number as `id`; a client that sends it as Last-Event-ID misses nothing. One
    that knows more events than there are, as after an older catalogue was restored, gets all.
    Between them events of the type `progress`, without a number, say how far the job is.
    A stream ends, too, when its key is revoked or expires.
    """
    if last_event_id:
        (status,) = await run_in_threadpool(catalogue.statuses, [job.id])
        if last_event_id > status.last_event:
            last_event_id = 0
        elif last_event_id == status.last_event and status.state.terminal:
            return Response(status_code=204)  # which tells a browser not to come back
    SHARES.must_wait(request.scope)
    is_open = partial(request.app.state.authentication.still_open_to, caller)
    return EventSourceResponse(
        _stream(job, catalogue, watcher, last_event_id, is_open),
        headers={"Cache-Control": "no-store", "X-Accel-Buffering": "no"},
    )


async def _stream(
    job: Job,
    catalogue: Catalogue,
    watcher: Watcher,
    last: int,
    is_open: Callable[[], Awaitable[bool]],
) -> AsyncIterator[bytes]:
    yield format_sse_event(retry=_COME_BACK)
    with watcher.watching(job.id) as watch:
        async for status in watch.changes(_QUIET):
            if not await is_open():
                return
            if status is None:
                yield format_sse_event(comment="the job goes on")
                continue
            while last < status.last_event:
                page = await _further(catalogue, job.id, last)
                if not page:
                    break
                last = page[-1].seq
                yield b"".join(map(_of_history, page))
            progress = JobProgress.model_validate(vars(status) | {"progress": vars(status)})
            yield format_sse_event(event="progress", data_str=progress.model_dump_json())
            if status.state.terminal:
                return


async def _further(catalogue: Catalogue, job_id: str, last: int) -> tuple[Event, ...]:
    """Return a job's next events, once the catalogue answers."""
    while True:
        try:
            return await run_in_threadpool(catalogue.events, job_id, after=last, limit=_PAGE)
        except Unavailable as fault:
            _log.warning("looking again: %s", fault)
            await asyncio.sleep(_LOOK_AGAIN)


def _of_history(event: Event) -> bytes:
    shown = JobEvent.model_validate(vars(event) | {"time": moment(event.time).isoformat()})
    data = shown.model_dump_json()
    return format_sse_event(id=str(event.seq), event=event.type, data_str=data)
