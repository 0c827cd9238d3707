"""From a document to a queued job."""

from typing import Any

from solver.admission import Study, admit
from solver.version import SOLVER_VERSION
from storage.catalogue import Catalogue, Job, NewJob
from worker.app import wake_relay

REQUEST_BODY: dict[str, Any] = {
    "required": True,
    "description": "What to compute, told apart by its kind: all values in SI units.",
    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/JobDocument"}}},
}


def checked(document: object) -> NewJob:
    """Check a job's document and return what the catalogue takes.

    Raises
    ------
    InvalidInput
        With every field that is wrong.
    """
    admission = admit(document)
    study = admission if isinstance(admission, Study) else None
    return NewJob(
        kind=admission.job["kind"],
        label=admission.job["label"] or None,
        spec=admission.job,
        digest=admission.digest,
        solver_version=SOLVER_VERSION,
        blocks=((0, 1),) if study is None else study.blocks,
        seal=study is not None,
    )


def submit(catalogue: Catalogue, document: object) -> Job:
    """Check the document, record the job durably, and wake whoever publishes it.

    Raises
    ------
    InvalidInput
        With every field that is wrong; nothing was recorded.
    """
    submitted = catalogue.submit(checked(document))
    wake_relay()
    return submitted.job
