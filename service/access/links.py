"""``/v1/jobs/{id}/links``: make a signed link to the stored arrays of a job."""

from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import BaseModel, ConfigDict, Field

from jointplay.service.access import CallerDependency, needs
from jointplay.service.access.link_secret import LinkSecret
from jointplay.service.access.signed import PREFIX, Link
from jointplay.service.dependencies import (
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
    of_the_application,
)
from jointplay.service.fields import in_unit
from jointplay.service.jobs.schemas import Moment
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.storage.installation import require_reachable

router = APIRouter(prefix="/v1/jobs", tags=["results"])
_LONGEST = 366 * 86_400.0
LinkSecretDependency = Annotated[LinkSecret, of_the_application("link_secret")]


class LinkQuery(BaseModel):
    """Duration of a link."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)

    seconds: float = in_unit(
        "s", "After this time the link opens nothing.", default=86_400.0, ge=1.0, le=_LONGEST
    )


class SignedLink(BaseModel):
    """An address that needs no key; whoever has it can read the stored arrays of the job."""

    zarr: str = Field(description="Path of the store, for any Zarr client.")
    expires: Moment = Field(description="When it opens nothing any more; sooner with its key.")


@router.post(
    "/{job_id}/links",
    status_code=201,
    dependencies=[needs("results:read")],
    responses=problems(*kinds.OF_A_JOB, kinds.NOT_FOUND, kinds.INVALID_REQUEST),
)
def make_link(
    job: JobOfThePath,
    catalogue: CatalogueDependency,
    caller: CallerDependency,
    settings: SettingsDependency,
    secret: LinkSecretDependency,
    query: Annotated[LinkQuery, Query()],
) -> SignedLink:
    """Make a link to the stored arrays of one job, to be read and nothing else.

    It ends with the key that made it, at the latest after its time; it cannot be revoked alone.
    """
    if not caller.key:
        sentence = "This service asks for no key, so that links need none: use the job's own."
        raise RequestRefused(kinds.NOT_FOUND, sentence)
    until = int(catalogue.clock() + query.seconds)
    require_reachable(settings, catalogue)  # before a secret is made where no disk is mounted
    token = Link(job.id, until, caller.key).signed_with(secret.made(), catalogue.key(caller.key))
    shown = {"zarr": f"{PREFIX}{token}/zarr", "expires": float(until)}
    return SignedLink.model_validate(shown)
