"""``/v1/jobs/{id}/bifurcation``, ``/sweep``, ``/accuracy`` and ``/poincare``, as they grow."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from jointplay.service.dependencies import (
    NO_PARAMETERS,
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
)
from jointplay.service.jobs.results_of_kinds import insist, is_study
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results import answers as of_runs
from jointplay.service.results.negotiation import JSON, Form
from jointplay.service.results.schemas import Poincare, as_json
from jointplay.service.results.stores import open_store, open_study
from jointplay.service.results.tables import AS_FILES, as_file
from jointplay.service.studies import answers, schemas
from jointplay.service.studies.queries import BifurcationQuery, PoincareQuery, SweepQuery
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["studies"],
    responses=problems(*kinds.OF_RESULTS),
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


@router.get(
    "/poincare",
    response_model=Poincare | schemas.Sections,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
)
def show_poincare(
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
    query: Annotated[PoincareQuery, Query()],
    form: Form,
) -> Response:
    """Return channels at the Poincare sections.

    Of a simulation: once in every period, in a window of time.  Of a study: at the sections that
    each of its points has recorded so far; start and stop are a range of points.  Accept chooses
    JSON, or of a simulation CSV, NPZ or a MATLAB file.
    """
    insist(job, "poincare")
    if not is_study(job):
        found = of_runs.sections(open_store(job, settings, catalogue), query.window_of_time())
        if form == JSON:
            return as_json(found)
        columns = of_runs.columns_of(found)
        return as_file(form, f"{job.id}-poincare", columns, complete=found.complete)
    if form != JSON:
        raise RequestRefused(
            kinds.NOT_ACCEPTABLE, f"Sections of a study are there as {JSON} and as Zarr."
        )
    study = open_study(job, settings)
    return as_json(answers.sections(study, query.range_of_points(), query.channels))
