"""``/v1/estimates``: what a job will cost, before anything is queued."""

from typing import Annotated

from fastapi import APIRouter, Depends, Request
from pydantic import BaseModel, Field

from jointplay.service.body import JsonDocument
from jointplay.service.dependencies import NO_PARAMETERS, CatalogueDependency, SettingsDependency
from jointplay.service.jobs.submission import REQUEST_BODY, checked
from jointplay.service.prober import Prober
from jointplay.service.problems import kinds, problems

router = APIRouter(prefix="/v1/estimates", tags=["jobs"])


class Estimate(BaseModel):
    """Cost of a job on the machine of the service."""

    seconds: float = Field(
        description="Computing time of one core; compiling is not in it, nor waiting in the queue.",
        json_schema_extra={"unit": "s"},
    )
    steps: int = Field(description="Accepted steps of the solver.", json_schema_extra={"unit": "1"})
    bytes: int = Field(
        description="What the results take on the disk.", json_schema_extra={"unit": "B"}
    )
    points: int = Field(description="Points of a study; 1 of a simulation.")
    blocks: int = Field(description="Parts that workers can compute at the same time.")
    exact: bool = Field(
        description="Whether the whole job was computed for it, and not only its beginning."
    )
    failure: str | None = Field(description="Why the job, or a point of it, will end early.")
    cached: bool = Field(
        description="Whether an identical job is there, so that a submission costs nothing."
    )


async def _prober(request: Request) -> Prober:
    prober: Prober = request.app.state.prober
    return prober


@router.post(
    "",
    dependencies=[NO_PARAMETERS],
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=problems(*kinds.OF_A_BODY, kinds.INVALID_REQUEST, kinds.UNAVAILABLE),
)
def estimate_job(
    document: JsonDocument,
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    prober: Annotated[Prober, Depends(_prober)],
) -> Estimate:
    """Say what a job will cost, and queue nothing.

    The document is checked as POST /v1/jobs checks it.  Then half a second of the job is computed
    on this machine; the pace at the end of it is taken for the rest.
    """
    new, reuse = checked(document, settings)
    cached = reuse and catalogue.identical(new) is not None
    return Estimate(**prober.cost_of(new.spec), cached=cached)
