"""``/v1/usage``: what the owner of a key has, and may have at most."""

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.access import Caller, CallerDependency
from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.storage.catalogue.quotas import NO_QUOTA, Quota
from jointplay.storage.settings import Settings

router = APIRouter(prefix="/v1/usage", tags=["service"])


class Usage(BaseModel):
    """Use and limits of one owner; a limit of 0 is none."""

    owner: str = Field(description="Empty where the service asks for no keys.")
    live_jobs: int = Field(description="Jobs that have not ended.")
    most_live_jobs: int
    running_blocks: int = Field(description="Blocks that are computed now.")
    most_running_blocks: int = Field(description="Further ones wait, and others go by.")
    stored_bytes: int | None = Field(
        description="Bytes of results, of jobs that have ended; null without a key: not counted."
    )
    most_stored_bytes: int
    core_seconds: float | None = Field(
        description="Time in the last 24 hours for which workers, of one core each, held blocks, s;"
        " null without a key: not counted."
    )
    most_core_seconds: float


def quota_of(caller: Caller, settings: Settings) -> Quota:
    """Return the limits of a caller; none of an administrator's, and where no keys are asked."""
    if not caller.owner or caller.sees_all:
        return NO_QUOTA
    return Quota(settings.most_live, settings.most_stored, settings.most_computed)


@router.get("")
def show_usage(
    caller: CallerDependency, catalogue: CatalogueDependency, settings: SettingsDependency
) -> Usage:
    """Show what your jobs use, and what they may; results are counted soon after jobs end."""
    use, quota = catalogue.use_of(caller.owner), quota_of(caller, settings)
    most_running = settings.most_running if caller.owner else 0  # whatever the key
    return Usage(
        owner=caller.owner,
        live_jobs=use.live,
        most_live_jobs=quota.live,
        running_blocks=use.running,
        most_running_blocks=most_running,
        stored_bytes=use.stored if caller.owner else None,
        most_stored_bytes=quota.stored,
        core_seconds=use.computed if caller.owner else None,
        most_core_seconds=quota.computed,
    )
