"""``/v1/jobs/{id}/figures``: figures as the paper draws them, from the same code everywhere."""

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query, Response
from pydantic import Field

from jointplay import figures
from service.dependencies import NO_PARAMETERS, JobOfThePath
from service.jobs.schemas import address
from service.problems import ErrorDetail, RequestRefused, kinds, problems
from service.problems.document import clipped
from service.results.queries import Selection, chosen_channels
from service.results.schemas import FigureLink, Figures
from service.results.stores import StoreOfThePath

router = APIRouter(
    prefix="/v1/jobs/{job_id}/figures",
    tags=["results"],
    responses=problems(
        kinds.UNKNOWN_JOB, kinds.NO_RESULTS, kinds.RESULTS_NOT_READY, kinds.INVALID_REQUEST
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
    """What a figure shows."""

    joints: str | None = Field(
        default=None,
        max_length=2000,
        description="Clearance joints, separated by commas; default: all.",
    )


@router.get("", dependencies=[NO_PARAMETERS])
def list_figures(job: JobOfThePath, store: StoreOfThePath) -> Figures:
    """List the figures that can be drawn of what the job stored."""
    base = f"{address(job.id)}/figures"
    return Figures(
        figures=[
            FigureLink(
                name=one.name,
                title=one.title,
                png=f"{base}/{one.name}.png",
                svg=f"{base}/{one.name}.svg",
            )
            for one in figures.available(store)
        ]
    )


@router.get(
    "/{name}.{form}",
    response_class=Response,
    responses=_DRAWN | problems(kinds.UNKNOWN_FIGURE, kinds.NOT_DRAWABLE, kinds.UNKNOWN_CHANNEL),
)
def draw_figure(
    store: StoreOfThePath,
    name: Annotated[str, Path(description="Name of a figure, or of any channel.")],
    form: Annotated[Literal["png", "svg"], Path(description="File type.")],
    selection: Annotated[FigureSelection, Query()],
) -> Response:
    """Draw a figure of the job's results."""
    start, stop = selection.checked()
    channels = (
        ()
        if selection.channels is None
        else chosen_channels(selection.channels, [channel.name for channel in store.channels])
    )
    joints = () if selection.joints is None else selection.joints.split(",")
    chosen = figures.Selection(tuple(channels), tuple(joints), start, stop)
    try:
        picture = figures.render(store, name, form, chosen)
    except figures.UnknownFigure as error:
        raise _refused(kinds.UNKNOWN_FIGURE, "name", error) from None
    except figures.NotDrawable as error:
        raise _refused(kinds.NOT_DRAWABLE, error.cause, error) from None
    return Response(picture, media_type=_MEDIA_TYPES[form])


def _refused(kind: kinds.Kind, parameter: str, error: Exception) -> RequestRefused:
    sentence = clipped(str(error))
    return RequestRefused(kind, sentence, [ErrorDetail(parameter=parameter, detail=sentence)])
