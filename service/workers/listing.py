"""``/v1/workers``: who computes, and what each one has."""

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.access import CallerDependency
from jointplay.service.dependencies import CatalogueDependency
from jointplay.service.fields import in_unit
from jointplay.service.jobs.schemas import Moment
from jointplay.service.problems import kinds, problems

router = APIRouter(prefix="/v1/workers", tags=["workers"])


class BlockAtWork(BaseModel):
    """A part of a job that a worker is computing."""

    job: str | None = Field(description="Id of the job; null: another owner's.")
    block: int = Field(ge=0, description="Its index among the blocks of the job, from 0.")
    attempt: int = Field(ge=1, description="Counts from 1.")
    since: Moment


class Worker(BaseModel):
    """One process that computes blocks of jobs."""

    name: str = Field(description="Of its machine and process, as events of jobs have it.")
    version: str = Field(description="Version of its solver; jobs keep to the one they began with.")
    processor: str = Field(description="Class of the processor that it compiles for.")
    since: Moment | None = Field(
        description="When it was heard of first; null: before the service kept this."
    )
    seen: Moment = Field(description="When it was heard of last.")
    device: str | None = Field(
        description="Graphics processor that computes points of studies for it; null: it has none."
    )
    rate: float | None = in_unit(
        "1/s", "Accepted steps of that processor, as it was tried when the worker started."
    )
    lanes: int | None = Field(description="Points that it computes at a time.")
    blocks: list[BlockAtWork]


class Workers(BaseModel):
    """Workers that were heard of in the last minute, by name."""

    workers: list[Worker]


@router.get("", responses=problems(kinds.INVALID_REQUEST))
def list_workers(catalogue: CatalogueDependency, caller: CallerDependency) -> Workers:
    """List the workers that are alive; none: what is queued waits until one is started."""
    found = []
    for one in catalogue.workers_at_work():
        blocks = [
            {
                "job": held.job if caller.sees(held.owner) else None,
                "block": held.index,
                "attempt": held.attempt,
                "since": held.since,
            }
            for held in one.blocks
        ]
        found.append(Worker.model_validate(vars(one) | {"blocks": blocks}))
    return Workers(workers=found)
