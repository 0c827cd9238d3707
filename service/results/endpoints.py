"""``/v1/jobs/{id}/history`` and its siblings: numbers that a job has computed."""

from typing import Annotated

import numpy as np
from fastapi import APIRouter, Query, Response
from numpy.typing import NDArray

from jointplay.records.certificate import certificate_document
from jointplay.records.channel import by_name
from jointplay.service.dependencies import (
    NO_PARAMETERS,
    JobOfThePath,
)
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results import answers, schemas
from jointplay.service.results.answers import columns_of
from jointplay.service.results.certificate_schema import Certificate
from jointplay.service.results.negotiation import JSON, Form
from jointplay.service.results.queries import (
    ChannelsQuery,
    HistoryQuery,
    Window,
    check_size,
    chosen_channels,
)
from jointplay.service.results.schemas import as_json
from jointplay.service.results.stores import StoreOfThePath, not_ready
from jointplay.service.results.tables import AS_FILES, as_file

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["results"],
    responses=problems(*kinds.OF_RESULTS),
)
Floats = NDArray[np.float64]


@router.get(
    "/history",
    response_model=schemas.History | schemas.Overview,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
)
def show_history(
    job: JobOfThePath,
    store: StoreOfThePath,
    query: Annotated[HistoryQuery, Query()],
    form: Form,
) -> Response:
    """Return channels on the output grid, in a window of time; of a running job as far as it is.

    With `points`, smallest and largest values of that many groups of samples, so that no peak is
    lost.  Accept chooses JSON, CSV, NPZ or a MATLAB file.
    """
    answer = answers.history(store, query)
    if form == JSON:
        return as_json(answer)
    return as_file(form, f"{job.id}-history", columns_of(answer), complete=store.complete)


@router.get("/peaks", response_model=schemas.Peaks, dependencies=[NO_PARAMETERS])
def show_peaks(store: StoreOfThePath) -> Response:
    """Return each channel's signed minimum and maximum, with their times."""
    return as_json(answers.peaks(store))


@router.get("/statistics", dependencies=[NO_PARAMETERS])
def show_statistics(store: StoreOfThePath) -> schemas.Statistics:
    """Return the steps that the run took, and its energy ledger with the residual."""
    summary = store.attributes.get("summary") or {}
    return schemas.Statistics(complete=store.complete, **summary)


@router.get("/certificate", response_model=Certificate)
def show_certificate(
    job: JobOfThePath, store: StoreOfThePath, query: Annotated[ChannelsQuery, Query()]
) -> Response:
    """Return how far the numbers can be believed: estimated errors, horizon, exponent, spread.

    It is made when the run ends; a job with `"certificate": false` has none.
    """
    found = store.certificate()
    if found is None and not store.sealed:
        raise not_ready(job, "its certificate is made when it ends")
    if found is None:
        raise RequestRefused(kinds.NO_RESULTS, f"Job {job.id} was computed without a certificate.")
    names = chosen_channels(query.channels, list(by_name(store.channels)))
    instants = len(found.arrays["time"].values)
    check_size(instants, len(names), "instants", float(job.spec["duration"]))
    return as_json(Certificate.model_validate(certificate_document(store, found, names)))


@router.get("/impacts", response_model=schemas.Impacts)
def show_impacts(store: StoreOfThePath, window: Annotated[Window, Query()]) -> Response:
    """Return the contacts in the clearance joints whose onset is in a window of time."""
    return as_json(answers.impacts(store, window))
