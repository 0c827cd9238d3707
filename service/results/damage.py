"""The answer where files of a job's results are not what was stored.

Nothing of such a file is served. A finished job is marked as damaged: it is no longer the answer
to identical submissions, so that submitting its document again computes it anew. A job that runs is
left alone: its worker finds the same before the end, and computes again what was lost. So is every
job while the files are not those of the catalogue, as where a disk is not mounted.
"""

import logging

from fastapi import Request
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import Response

from jointplay.service.dependencies import expired
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.problems.handlers import answer
from jointplay.service.problems.refusals import refusal
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import NOT_REPRODUCED
from jointplay.storage.installation import OtherFiles, require_own_files
from jointplay.storage.settings import Settings

_log = logging.getLogger(__name__)


async def answer_damage(request: Request, error: Exception) -> Response:
    """Answer a request for results with the problem that names the damaged file."""
    job, state = request.path_params["job_id"], request.app.state
    found = await run_in_threadpool(refusal_of, job, state.settings, state.catalogue, str(error))
    return await answer(request, found)


def refusal_of(job_id: str, settings: Settings, catalogue: Catalogue, found: str) -> RequestRefused:
    """Return the refusal of a job's results that are damaged, and mark a finished one as such."""
    try:
        job = catalogue.get(job_id)
        if catalogue.expired(job):  # its files go while it is read
            return expired(job)
        require_own_files(settings, catalogue)
        if job.state.terminal and job.damaged not in (found, NOT_REPRODUCED):
            _log.error("results of job %s are damaged: %s", job_id, found)
            catalogue.mark_damaged(job_id, found)
    except OtherFiles as error:
        _log.error("results of job %s are not looked at: %s", job_id, error)
        return refusal(ConnectionError())
    except Unavailable as fault:
        _log.warning("job %s is not marked as damaged: %s", job_id, fault)
        job = None
    if job is not None and not job.state.terminal:
        sentence = (
            f"Results of job {job_id} so far are damaged: {found}. The job is {job.state}; what"
            " was lost is computed again before it ends."
        )
        return RequestRefused(kinds.RESULTS_NOT_READY, sentence, headers={"Retry-After": "1"})
    sentence = (
        f"Results of job {job_id} are damaged: {found}. POST its document, the field `job` of"
        f" /v1/jobs/{job_id}, to /v1/jobs: that computes it anew."
    )
    # a file that is restored is served again, so that nobody shall keep this answer
    return RequestRefused(kinds.DAMAGED_RESULTS, sentence, headers={"Cache-Control": "no-store"})
