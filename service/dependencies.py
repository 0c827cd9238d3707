"""Dependencies of endpoints on the application: the catalogue, the settings, a job of the path."""

from datetime import UTC, datetime
from typing import Annotated

from fastapi import Depends, Path, Request
from fastapi.exceptions import RequestValidationError

from jointplay.records.job import is_job_id
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.problems.document import clipped
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import Job
from jointplay.storage.settings import Settings

# dependencies that wait for nothing are coroutines: others cost a change of thread each


async def _catalogue(request: Request) -> Catalogue:
    catalogue: Catalogue = request.app.state.catalogue
    return catalogue


async def _settings(request: Request) -> Settings:
    settings: Settings = request.app.state.settings
    return settings


async def _no_parameters(request: Request) -> None:
    """Refuse query parameters where there are none, in the words for unknown ones elsewhere."""
    errors = [
        {"loc": ("query", name), "msg": "Extra inputs are not permitted"}
        for name in request.query_params
    ]
    if errors:
        raise RequestValidationError(errors)


NO_PARAMETERS = Depends(_no_parameters)
CatalogueDependency = Annotated[Catalogue, Depends(_catalogue)]
SettingsDependency = Annotated[Settings, Depends(_settings)]


def found(catalogue: Catalogue, job_id: str) -> Job:
    """Return the job, or refuse with 404 or 410; the id is matched before it is looked up."""
    if is_job_id(job_id):
        try:
            job = catalogue.get(job_id)
        except JobNotFound:
            pass
        else:
            if catalogue.expired(job):
                raise RequestRefused(kinds.EXPIRED_JOB, _gone(job))
            return job
    sentence = f"There is no job {clipped(job_id)!r}; GET /v1/jobs lists the jobs."
    raise RequestRefused.of_parameter("job_id", sentence, kinds.UNKNOWN_JOB)


def _gone(job: Job) -> str:
    moment = datetime.fromtimestamp(job.expires or 0.0, UTC)
    return f"Job {job.id} expired or was deleted at {moment:%Y-%m-%dT%H:%M:%SZ}."


JobId = Annotated[str, Path(description="Id of the job, as POST /v1/jobs returned it.")]


def _job_of_the_path(catalogue: CatalogueDependency, job_id: JobId) -> Job:
    return found(catalogue, job_id)


JobOfThePath = Annotated[Job, Depends(_job_of_the_path)]


async def require_room(settings: SettingsDependency) -> None:
    """Refuse new work when the disk is nearly full, so that running jobs can end."""
    if settings.room() <= settings.reserve:
        detail = "The disk of the service is full but for a reserve; nothing was recorded."
        raise RequestRefused(kinds.DISK_FULL, detail, headers={"Retry-After": "30"})
