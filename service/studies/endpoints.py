"""``/v1/jobs/{id}/points``: the points of any study.

``/bifurcation``, ``/branch``, ``/sweep``, ``/accuracy`` and ``/poincare`` show parts of it,
``/sensitivity`` what follows from it, ``/calibration`` what a search found.
"""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from jointplay.records.calibration_misfit import with_misfits
from jointplay.records.sensitivity.analysis import NoSuchOutput, sensitivity
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results.endpoints import show_sections
from jointplay.service.results.forms import AS_FILES, IN_TURN, JSON, VARY, Form
from jointplay.service.results.schemas import Poincare
from jointplay.service.results.stores import ResultsOfThePath, StudyOfThePath
from jointplay.service.results.streaming import as_json
from jointplay.service.studies import answers, schemas
from jointplay.service.studies.calibration_schema import Calibration
from jointplay.service.studies.queries import (
    BifurcationQuery,
    BranchQuery,
    PoincareQuery,
    PointsQuery,
    SweepQuery,
)
from jointplay.service.studies.sensitivity_schema import Sensitivity, SensitivityQuery
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["studies"],
    responses=problems(*kinds.OF_RESULTS),
)


@router.get("/points", response_model=schemas.Points)
def show_points(study: StudyOfThePath, query: Annotated[PointsQuery, Query()]) -> Response:
    """Return all that a study of any kind has of its points, also while it runs.

    `status` says of every point whether it waits, is computed, is done or has failed.  A map has
    its points coarse to fine; `values` say where each of them lies, `shape` and `axes` what there
    is.  `next_start` leads to the points that did not fit into the answer.
    """
    return as_json(answers.points(study, query))


@router.get("/bifurcation", response_model=schemas.Bifurcation)
def show_bifurcation(
    study: StudyOfThePath, query: Annotated[BifurcationQuery, Query()]
) -> Response:
    """Return an observable at the sections of every value of the parameter.

    Also while the job runs: `status` says of every value whether it waits, is computed, is done
    or has failed.  `next_start` leads to the values that did not fit into the answer.
    """
    return as_json(answers.bifurcation(study, query))


@router.get("/branch", response_model=schemas.Branches)
def show_branch(study: StudyOfThePath, query: Annotated[BranchQuery, Query()]) -> Response:
    """Return the periodic orbits of a continuation and what changes along them, also while it runs.

    Orbits follow one another in the order of being found: sorted by `length`, they are the branch.
    """
    return as_json(answers.branch(study, query))


@router.get("/sweep", response_model=schemas.Sweep)
def show_sweep(study: StudyOfThePath, query: Annotated[SweepQuery, Query()]) -> Response:
    """Return the signed extremes of channels at every point of a sweep, also while it runs."""
    return as_json(answers.sweep(study, query))


@router.get("/sensitivity", response_model=Sensitivity)
def show_sensitivity(
    study: StudyOfThePath, query: Annotated[SensitivityQuery, Query()]
) -> Response:
    """Return what one output owes to each parameter, its quantiles, and how probable a limit is.

    Also while the job runs, of the rows that are whole.  Every output is there without new runs.
    """
    try:
        found = sensitivity(study, query.question())
    except NoSuchOutput as error:
        raise RequestRefused.of_parameter("output", str(error)) from None
    return as_json(Sensitivity.model_validate(found))


@router.get("/accuracy", response_model=schemas.Accuracy)
def show_accuracy(study: StudyOfThePath) -> Response:
    """Return what each method and tolerance costs and buys, as far as it was measured.

    The same study gives the same errors, steps and evaluations, hence the same advice; `seconds`
    are those of the machine and the moment.
    """
    return as_json(schemas.Accuracy.model_validate(WorkPrecision.of(study).document()))


@router.get("/calibration", response_model=Calibration)
def show_calibration(results: ResultsOfThePath) -> Response:
    """Return the parameters that were found, how far each is known, and the search's history.

    It is there when the search has ended; the same calibration finds the same.
    """
    results.insist("calibration")
    study = results.study()
    if 0 in study.documents:
        return as_json(Calibration.model_validate(with_misfits(study.documents[0])))
    job = results.job
    if not job.state.terminal:
        raise results.not_ready("what it found is there when its search has ended")
    why = f" {job.error.detail}" if job.error else ""
    raise RequestRefused(kinds.NO_RESULTS, f"Job {job.id} is {job.state} and found nothing.{why}")


@router.get(
    "/poincare",
    response_model=Poincare | schemas.Sections,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
    dependencies=[IN_TURN],
)
def show_poincare(
    results: ResultsOfThePath, query: Annotated[PoincareQuery, Query()], form: Form
) -> Response:
    """Return channels at the Poincare sections.

    Of a simulation: once in every period, in a window of time.  Of a study: at the sections that
    each of its points has recorded so far; start and stop are a range of points.  Accept chooses
    JSON, or of a simulation CSV, NPZ or a MATLAB file.
    """
    results.insist("poincare")
    if not results.is_study:
        run = results.run()
        query.refuse_sections()
        return show_sections(results.job.id, run, query, form)
    if form != JSON:
        raise RequestRefused(
            kinds.NOT_ACCEPTABLE,
            f"Sections of a study are there as {JSON} and as Zarr.",
            headers=VARY,
        )
    sections = answers.sections(results.study(), query.range_of_points(), query.channels)
    return as_json(sections, VARY)
