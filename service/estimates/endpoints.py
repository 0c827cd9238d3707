"""``/v1/estimates``: what a job will cost, before anything is queued."""

from typing import Annotated

from fastapi import APIRouter, Depends, Request

from jointplay.service.body import JsonDocument
from jointplay.service.dependencies import NO_PARAMETERS, CatalogueDependency, SettingsDependency
from jointplay.service.estimates.prober import Prober
from jointplay.service.estimates.schemas import Estimate
from jointplay.service.jobs.submission import REQUEST_BODY, checked
from jointplay.service.problems import kinds, problems

router = APIRouter(prefix="/v1/estimates", tags=["jobs"])


async def _prober(request: Request) -> Prober:
    prober: Prober = request.app.state.prober
    return prober


@router.post(
    "",
    dependencies=[NO_PARAMETERS],
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=problems(
        kinds.MALFORMED_JSON,
        kinds.BODY_TOO_LARGE,
        kinds.NOT_JSON,
        kinds.INVALID_JOB,
        kinds.LIMIT_EXCEEDED,
        kinds.INVALID_REQUEST,
        kinds.UNAVAILABLE,
    ),
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
