"""``/v1/jobs/{id}/figures``: figures as the paper draws them, from the same code everywhere."""

from typing import Annotated, Any, cast

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool

from jointplay import figures
from jointplay.records.channel_choice import NoSuchChannel
from jointplay.records.figure_form import FORMS, IN_WORDS, MEDIA_TYPES, Form
from jointplay.service.dependencies import of_the_application
from jointplay.service.fair_semaphore import FairSemaphore, slot_for
from jointplay.service.fields import BINARY
from jointplay.service.jobs.schemas import address
from jointplay.service.problems import RequestRefused, clipped, kinds, problems
from jointplay.service.results.damage import refusal_of
from jointplay.service.results.figure_query import FigureQuery, FigureSelection
from jointplay.service.results.queries import unknown_channels
from jointplay.service.results.schemas import FigureLink, Figures
from jointplay.service.results.stores import ResultsOfAParameter, ResultsOfJob, ResultsOfThePath
from jointplay.service.windows import WindowProcess
from jointplay.storage.errors import CorruptStore
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader

router = APIRouter(
    prefix="/v1/jobs/{job_id}/figures",
    tags=["results"],
    responses=problems(*kinds.OF_STORES),
)
_DRAWN: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The figure.",
        "content": dict.fromkeys(MEDIA_TYPES.values(), BINARY),
    }
}


@router.get("")
def list_figures(
    results: ResultsOfThePath, windows: Annotated[WindowProcess, of_the_application("windows")]
) -> Figures:
    """List the figures that can be drawn of what the job has stored, also as it runs.

    Stored metadata decide: nothing is computed for the list.
    """
    base = f"{address(results.job.id)}/figures"
    return Figures(
        figures=[
            FigureLink(
                name=one.name,
                title=one.title,
                **{form: f"{base}/{one.name}.{form}" for form in FORMS},
            )
            for one in figures.available(_reader(results, windows))
        ]
    )


@router.get(
    "/{name}.{form}",
    response_class=Response,
    responses=_DRAWN | problems(kinds.UNKNOWN_FIGURE, kinds.NOT_DRAWABLE, kinds.UNKNOWN_CHANNEL),
)
async def draw_figure(
    request: Request,
    results: ResultsOfThePath,
    name: Annotated[str, Path(description="Name of a figure, or of any channel.")],
    form: Annotated[str, Path(description="File type: png, svg, pdf or eps.")],
    query: Annotated[FigureQuery, Query()],
    windows: Annotated[WindowProcess, of_the_application("windows")],
    results_of: ResultsOfAParameter,
    drawing: Annotated[FairSemaphore, of_the_application("drawing")],
) -> Response:
    """Draw a figure of the job's results, also as it runs."""
    if form not in FORMS:
        sentence = f"Figures are drawn as {IN_WORDS}, not as {clipped(form)!r}."
        raise RequestRefused.of_parameter("form", sentence, kinds.UNKNOWN_FIGURE)
    selection = cast("FigureSelection", query)
    async with slot_for(request, drawing):
        return await run_in_threadpool(_drawn, results, name, form, selection, windows, results_of)


def _drawn(
    results: ResultsOfJob,
    name: str,
    form: Form,
    selection: FigureSelection,
    windows: WindowProcess,
    results_of: ResultsOfAParameter,
) -> Response:
    store = _reader(results, windows)
    if isinstance(store, ResultReader):
        selection.checked()
    beneath = None if selection.over is None else _beneath(results_of, selection.over)
    over = None if beneath is None else _map(beneath)
    channels, joints = (
        [] if one is None else one.split(",") for one in (selection.channels, selection.joints)
    )
    try:
        chosen = figures.select(store, channels, joints, selection.start, selection.stop, over)
        picture = figures.render(store, name, form, chosen, selection.options())
    except figures.UnknownFigure as error:
        raise RequestRefused.of_parameter("name", str(error), kinds.UNKNOWN_FIGURE) from None
    except figures.NotDrawable as error:
        raise RequestRefused.of_parameter(error.cause, str(error), kinds.NOT_DRAWABLE) from None
    except NoSuchChannel as error:
        raise unknown_channels(error) from None
    except CorruptStore as error:
        if beneath is None or beneath.job.id not in str(error):
            raise
        raise _damaged(beneath, error) from error
    return Response(picture, media_type=MEDIA_TYPES[form])


def _beneath(results_of: ResultsOfAParameter, job_id: str) -> ResultsOfJob:
    """Return the job whose results lie beneath a figure; what refuses it names the parameter."""
    try:
        found = results_of(job_id, "over")
        found.insist("bifurcation" if found.job.kind == "bifurcation" else "chart")
    except RequestRefused as error:
        raise _naming_over(error) from None
    return found


def _map(beneath: ResultsOfJob) -> StudyReader:
    """Return these results; what refuses them names the parameter."""
    try:
        return beneath.study()
    except RequestRefused as error:
        raise _naming_over(error) from None
    except CorruptStore as error:
        raise _damaged(beneath, error) from error


def _damaged(beneath: ResultsOfJob, error: CorruptStore) -> RequestRefused:
    """Return the refusal of results that are damaged, which are not those of the path."""
    found = refusal_of(beneath.job.id, beneath.settings, beneath.catalogue, str(error))
    return _naming_over(found)


def _naming_over(error: RequestRefused) -> RequestRefused:
    return RequestRefused.of_parameter("over", error.detail, error.kind, headers=error.headers)


def _reader(results: ResultsOfJob, windows: WindowProcess) -> ResultReader | StudyReader:
    results.insist("figures")
    if results.is_study:
        return results.study()
    reader = results.run()
    reader.trajectory = windows.of(reader)
    return reader
