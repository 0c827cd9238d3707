"""From a document to a queued job."""

import time
from dataclasses import replace
from typing import Any

from jointplay.records.failure import InvalidInput
from jointplay.service.jobs import request
from jointplay.solver.kinds import Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue import Catalogue, NewJob, SubmissionKey, Submitted
from jointplay.storage.settings import Settings
from jointplay.worker.wake_up import wake_relay

REQUEST_BODY: dict[str, Any] = {
    "required": True,
    "description": "What to compute, by its kind; all values in SI units.",
    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/JobDocument"}}},
}


def checked(document: object, settings: Settings) -> tuple[NewJob, bool]:
    """Check a job's document; return what the catalogue takes, and whether to reuse a result.

    Raises
    ------
    InvalidInput
        With every field that is wrong.
    """
    keep = None if settings.keep is None else time.time() + settings.keep
    document, wishes, problems = request.take(document, keep)
    try:
        new = _admitted(document)
    except InvalidInput as error:
        if not problems:
            raise
        raise InvalidInput([*problems, *error.problems]) from None
    if problems:
        raise InvalidInput(problems)
    return replace(new, expires=wishes.expires), wishes.cache


def _admitted(document: object) -> NewJob:
    admission = admit(document)
    study = admission if isinstance(admission, Study) else None
    scene = admission.job["scene"]
    return NewJob(
        kind=admission.job["kind"],
        label=admission.job["label"] or None,
        spec=admission.job,
        digest=admission.digest,
        solver_version=SOLVER_VERSION,
        scene=scene.get("preset") or scene.get("name"),
        blocks=((0, 1),) if study is None else study.blocks,
        seal=study is not None,
    )


def submit(
    catalogue: Catalogue, settings: Settings, document: object, key: SubmissionKey | None = None
) -> Submitted:
    """Check the document, record the job durably, and wake the relay.

    Raises
    ------
    InvalidInput
        With every field that is wrong; nothing was recorded.
    KeyReused
        The key came with another document before.
    """
    new, reuse = checked(document, settings)
    submitted = catalogue.submit(new, key, reuse=reuse)
    if submitted.created:
        wake_relay(settings.redis_url)
    return submitted
