"""Dependencies of endpoints for workers: the document that one sends, the block of the path."""

from typing import Annotated, Any, TypeVar

from fastapi import Depends, Path
from fastapi.concurrency import run_in_threadpool
from fastapi.exceptions import RequestValidationError
from pydantic import ValidationError

from jointplay.service.access import Caller, CallerDependency
from jointplay.service.body import WordBody
from jointplay.service.dependencies import CatalogueDependency
from jointplay.service.vital import VitalDependency
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block, Job
from jointplay.worker.joined.protocol import Document

Sent = TypeVar("Sent", bound=Document)


def document_of(kind: type[Sent]) -> Any:
    """Return the dependency on a body that is a document of a kind."""

    async def read(body: WordBody) -> Sent:
        try:
            return kind.model_validate_json(body)
        except ValidationError as error:
            raise RequestValidationError(error.errors(include_url=False)) from error

    return Depends(read)


def own_name(caller: Caller, worker: str) -> str:
    """Return the name of a worker that another key cannot take."""
    return f"{caller.key}@{worker}" if caller.key else worker


BlockId = Annotated[str, Path(pattern=r"^[0-9A-HJKMNP-TV-Z]{26}-\d{1,9}$")]
Attempt = Annotated[int, Path(ge=1, le=10**9)]


async def _held(
    catalogue: CatalogueDependency,
    caller: CallerDependency,
    vital: VitalDependency,
    block: BlockId,
    attempt: Attempt,
) -> Block:
    held: Block = await vital.run(catalogue.held, block, attempt)
    if not (held.worker or "").startswith(own_name(caller, "")):
        raise Fenced(block, attempt)
    return held


HELD = Depends(_held)
HeldBlock = Annotated[Block, HELD]
"""Block of the path; refused with 409 if its attempt, claimed with this key, does not hold it."""


async def _job(catalogue: CatalogueDependency, held: HeldBlock) -> Job:
    found: Job = await run_in_threadpool(catalogue.get, held.job)
    return found


JobOfBlock = Annotated[Job, Depends(_job)]
"""Job of that block."""
