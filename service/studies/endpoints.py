"""``/v1/jobs/{id}/bifurcation``, ``/sweep`` and ``/accuracy``: studies, as they grow."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from jointplay.service.dependencies import NO_PARAMETERS, JobOfThePath, SettingsDependency
from jointplay.service.jobs.results_of_kinds import insist
from jointplay.service.problems import kinds, problems
from jointplay.service.results.as_json import as_json
from jointplay.service.results.stores import open_study
from jointplay.service.studies import answers, schemas
from jointplay.service.studies.queries import BifurcationQuery, SweepQuery
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["studies"],
    responses=problems(
        kinds.UNKNOWN_JOB,
        kinds.EXPIRED_JOB,
        kinds.WRONG_KIND,
        kinds.NO_RESULTS,
        kinds.RESULTS_NOT_READY,
        kinds.INVALID_REQUEST,
        kinds.UNKNOWN_CHANNEL,
        kinds.RESPONSE_TOO_LARGE,
    ),
)


@router.get("/bifurcation", response_model=schemas.Bifurcation)
def show_bifurcation(
    job: JobOfThePath, settings: SettingsDependency, query: Annotated[BifurcationQuery, Query()]
) -> Response:
    """Return an observable at the sections of every value of the parameter.

    Also while the job runs: `status` says of every value whether it waits, is computed, is done
    or has failed.  `next_start` leads to the values that did not fit into the answer.
    """
    insist(job, "bifurcation")
    return as_json(answers.bifurcation(open_study(job, settings), query))


@router.get("/sweep", response_model=schemas.Sweep)
def show_sweep(
    job: JobOfThePath, settings: SettingsDependency, query: Annotated[SweepQuery, Query()]
) -> Response:
    """Return the signed extremes of channels at every point of a sweep, also while it runs."""
    insist(job, "sweep")
    return as_json(answers.sweep(open_study(job, settings), query))


@router.get("/accuracy", response_model=schemas.Accuracy, dependencies=[NO_PARAMETERS])
def show_accuracy(job: JobOfThePath, settings: SettingsDependency) -> Response:
    """Return what each method and tolerance costs and buys, as far as it was measured.

    The same study gives the same errors, steps and evaluations, hence the same advice; `seconds`
    are those of the machine and the moment.
    """
    insist(job, "accuracy")
    found = WorkPrecision.of(open_study(job, settings))
    return as_json(schemas.Accuracy.model_validate(found.document()))
