"""``/v1/jobs/{id}/figures``: figures as the paper draws them, from the same code everywhere."""

from typing import Annotated, Any, cast

from fastapi import APIRouter, Path, Query, Response
from pydantic import Field

from jointplay import figures
from jointplay.records.channel_choice import NoSuchChannel
from jointplay.service.dependencies import (
    NO_PARAMETERS,
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
)
from jointplay.service.jobs.results_of_kinds import insist, is_study
from jointplay.service.jobs.schemas import address
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.problems.document import clipped
from jointplay.service.results.queries import Selection, unknown_channels
from jointplay.service.results.schemas import FigureLink, Figures
from jointplay.service.results.stores import open_store, open_study
from jointplay.storage.catalogue import Catalogue, Job
from jointplay.storage.results import ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies import StudyReader

router = APIRouter(
    prefix="/v1/jobs/{job_id}/figures",
    tags=["results"],
    responses=problems(
        kinds.UNKNOWN_JOB,
        kinds.EXPIRED_JOB,
        kinds.WRONG_KIND,
        kinds.NO_RESULTS,
        kinds.RESULTS_NOT_READY,
        kinds.INVALID_REQUEST,
    ),
)


_MEDIA_TYPES = {"png": "image/png", "svg": "image/svg+xml"}
_DRAWN: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The figure.",
        "content": {
            media_type: {"schema": {"type": "string", "format": "binary"}}
            for media_type in _MEDIA_TYPES.values()
        },
    }
}


class FigureSelection(Selection):
    """Selection of what a figure shows."""

    start: float | None = Field(
        default=None,
        description="Of a simulation: from this time on, in s. Of a study: first point.",
    )
    stop: float | None = Field(
        default=None,
        description="Of a simulation: up to this time, in s. Of a study: point before which to "
        "end.",
    )
    joints: str | None = Field(
        default=None,
        max_length=2000,
        description="Clearance joints, separated by commas; default: all.",
    )


@router.get("", dependencies=[NO_PARAMETERS])
def list_figures(
    job: JobOfThePath, settings: SettingsDependency, catalogue: CatalogueDependency
) -> Figures:
    """List the figures that can be drawn of what the job has stored, also as it runs."""
    base = f"{address(job.id)}/figures"
    return Figures(
        figures=[
            FigureLink(
                name=one.name,
                title=one.title,
                png=f"{base}/{one.name}.png",
                svg=f"{base}/{one.name}.svg",
            )
            for one in figures.available(_results(job, settings, catalogue))
        ]
    )


@router.get(
    "/{name}.{form}",
    response_class=Response,
    responses=_DRAWN | problems(kinds.UNKNOWN_FIGURE, kinds.NOT_DRAWABLE, kinds.UNKNOWN_CHANNEL),
)
def draw_figure(
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
    name: Annotated[str, Path(description="Name of a figure, or of any channel.")],
    form: Annotated[str, Path(description="File type: png or svg.")],
    selection: Annotated[FigureSelection, Query()],
) -> Response:
    """Draw a figure of the job's results, also as it runs."""
    if form not in _MEDIA_TYPES:
        sentence = f"Figures are drawn as png or svg, not as {clipped(form)!r}."
        raise RequestRefused.of_parameter("form", sentence, kinds.UNKNOWN_FIGURE)
    store = _results(job, settings, catalogue)
    if isinstance(store, ResultReader):
        selection.checked()
    channels, joints = (
        [] if one is None else one.split(",") for one in (selection.channels, selection.joints)
    )
    try:
        chosen = figures.select(store, channels, joints, selection.start, selection.stop)
        picture = figures.render(store, name, cast("figures.Form", form), chosen)
    except figures.UnknownFigure as error:
        raise RequestRefused.of_parameter("name", str(error), kinds.UNKNOWN_FIGURE) from None
    except figures.NotDrawable as error:
        raise RequestRefused.of_parameter(error.cause, str(error), kinds.NOT_DRAWABLE) from None
    except NoSuchChannel as error:
        raise unknown_channels(error) from None
    return Response(picture, media_type=_MEDIA_TYPES[form])


def _results(job: Job, settings: Settings, catalogue: Catalogue) -> ResultReader | StudyReader:
    insist(job, "figures")
    return open_study(job, settings) if is_study(job) else open_store(job, settings, catalogue)
