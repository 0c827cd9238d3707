"""Dependencies of endpoints on the application: the catalogue, the settings, a job of the path."""

from collections import Counter
from contextlib import suppress
from datetime import UTC, datetime
from typing import Annotated, Any

from fastapi import Depends, Path, Request
from fastapi.exceptions import RequestValidationError

from jointplay.records.job import is_job_id
from jointplay.service.access import Caller, CallerDependency
from jointplay.service.checking import Checker
from jointplay.service.problems import RequestRefused, clipped, kinds
from jointplay.service.problems.parameters import query_names
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import Job
from jointplay.storage.settings import Settings

# dependencies that wait for nothing are coroutines: others cost a change of thread each; one that
# is asked for most takes the request and looks at the application, as each further one takes time


def of_the_application(name: str) -> Any:
    """Return the dependency on a thing that the application has once."""

    async def found(request: Request) -> Any:
        return getattr(request.app.state, name)

    return Depends(found)


async def _known_parameters(request: Request) -> None:
    """Refuse query parameters that are given twice, and any where an address has none.

    Of those that have some each refuses others.
    """
    if not request.scope["query_string"]:
        return
    given = Counter(name for name, _ in request.query_params.multi_items())
    if any(query_names(request.scope["route"].dependant)):
        kind, wrong = "repeated", [name for name, times in given.items() if times > 1]
    else:
        kind, wrong = "extra_forbidden", [*given]
    if wrong:
        raise RequestValidationError([{"type": kind, "loc": ("query", name)} for name in wrong])


KNOWN_PARAMETERS = Depends(_known_parameters)
CheckerDependency = Annotated[Checker, of_the_application("checker")]
CatalogueDependency = Annotated[Catalogue, of_the_application("catalogue")]
SettingsDependency = Annotated[Settings, of_the_application("settings")]


JobId = Annotated[str, Path(description="Id of the job, as POST /v1/jobs returned it.")]


def expired(job: Job) -> RequestRefused:
    """Return the refusal of a job that can be read no more."""
    moment = datetime.fromtimestamp(job.expires or job.deleted or job.removed or 0.0, UTC)
    sentence = f"Job {job.id} expired or was deleted at {moment:%Y-%m-%dT%H:%M:%SZ}."
    return RequestRefused(kinds.EXPIRED_JOB, sentence)


def visible_job(catalogue: Catalogue, caller: Caller, job_id: str, parameter: str) -> Job:
    """Return the job of a parameter, or refuse with 404 or 410; its id is matched first."""
    with suppress(JobNotFound):
        if is_job_id(job_id) and caller.sees((job := catalogue.get(job_id)).owner):
            if not catalogue.expired(job):
                return job
            raise expired(job)
    sentence = f"There is no job {clipped(job_id)!r}; GET /v1/jobs lists the jobs."
    raise RequestRefused.of_parameter(parameter, sentence, kinds.UNKNOWN_JOB)


def _job_of_the_path(
    catalogue: CatalogueDependency, caller: CallerDependency, job_id: JobId
) -> Job:
    return visible_job(catalogue, caller, job_id, "job_id")


JobOfThePath = Annotated[Job, Depends(_job_of_the_path)]
