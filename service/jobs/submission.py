"""From a document to a queued job."""

from typing import Any

from solver.admission import admit
from solver.version import SOLVER_VERSION
from storage.catalogue import Catalogue, Job, NewJob
from worker.app import wake_relay

REQUEST_BODY: dict[str, Any] = {
    "required": True,
    "description": "What to simulate: all values in SI units.",
    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/SimulateJob"}}},
}


def submit(catalogue: Catalogue, document: object) -> Job:
    """Check the document, record the job durably, and wake whoever publishes it.

    Raises
    ------
    InvalidInput
        With every field that is wrong; nothing was recorded.
    """
    admission = admit(document)
    submitted = catalogue.submit(
        NewJob(
            kind=admission.job["kind"],
            label=admission.job["label"] or None,
            spec=admission.job,
            digest=admission.digest,
            solver_version=SOLVER_VERSION,
        )
    )
    wake_relay()
    return submitted.job
