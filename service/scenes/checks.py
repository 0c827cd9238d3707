"""``/v1/scenes/check`` and ``/v1/scenes/drawing``: scenes looked at before they are run."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Response
from pydantic import BaseModel, Field, create_model

from jointplay.records.figure_form import FORMS, IN_WORDS, MEDIA_TYPES
from jointplay.records.page_option import OPTIONS
from jointplay.service.body import JobBody
from jointplay.service.dependencies import of_the_application
from jointplay.service.fields import BINARY, in_unit
from jointplay.service.problems import ErrorDetail, RequestRefused, clipped, kinds, problems
from jointplay.service.results.figure_query import PAGE_FIELDS
from jointplay.service.scenes.process import SceneProcess

router = APIRouter(prefix="/v1/scenes", tags=["scenes"])
_PATIENCE = 60.0  # s; a chain of 30 bodies takes 10 of them
_BODY: dict[str, Any] = {
    "required": True,
    "description": "A scene as a job has it: a preset with parameters, or a scene document.",
    "content": {"application/json": {"schema": {"type": "object"}}},
}
_DRAWN: dict[int | str, dict[str, Any]] = {
    200: {"description": "The drawing.", "content": dict.fromkeys(MEDIA_TYPES.values(), BINARY)}
}
_REFUSALS = problems(*kinds.OF_A_BODY, kinds.INVALID_REQUEST)


class GivenStart(BaseModel):
    """One value that a scene gives of its start, and the one that is taken."""

    pointer: str = Field(description="Where the scene has it.")
    unit: str
    given: list[float]
    taken: list[float] = Field(description="What the start has, in the same unit.")
    off: float = Field(
        description="Distance between both, m or m/s; of angles that of the body's farthest point."
    )
    kept: bool = Field(description="Whether they differ by no more than a drawing's last digits.")


class DeadPointMargin(BaseModel):
    """Gap at one joint that would make a dead point, or that remains where none is passed."""

    time: float = in_unit("s", "When the gap is extreme.")
    size: float = in_unit("m", "The gap.")
    joint: str
    drivers: dict[str, float] = Field(description="Positions of the drivers then, rad or m.")


class DriversTurn(BaseModel):
    """The mechanism, its clearances closed, while its drivers come round once."""

    span: float = in_unit("s", "How long they take.")
    reached: float = in_unit("s", "How far it was followed: to the end, unless it jams.")
    jams: bool = Field(description="Whether it comes to a dead point before.")
    drivers: dict[str, float] = Field(description="Positions of the drivers there, rad or m.")
    margin: DeadPointMargin | None = Field(
        description="How near it comes to a dead point; by how much it fails to pass one."
    )
    detail: str = Field(description="All of this in words.")


class Overshoot(BaseModel):
    """A smooth table that passes the two values beside, most at an argument."""

    pointer: str = Field(description="Where it is in the scene.")
    percent: float = Field(description="How far, in hundredths of the range of its values.")
    argument: float = Field(description="Where, in the unit of its knots.")
    detail: str


class ReplacedNumber(BaseModel):
    """A number, or a word, that the document has, and what a parameter's default puts there."""

    pointer: str = Field(description="Where it is in the scene.")
    parameter: str
    written: float | str
    taken: float | str


class Hint(BaseModel):
    """Something of the document that is allowed, and may be meant otherwise."""

    pointer: str = Field(description="Where it is, or would be, in the scene.")
    detail: str


class SceneFindings(BaseModel):
    """Findings of a check; with `problems` the scene cannot be run, and they say why."""

    scene: str
    bodies: list[str]
    joints_with_clearance: list[str]
    freedom: int = Field(description="Degrees of freedom, clearances open.")
    ideal_freedom: int = Field(description="The same without any clearance.")
    redundant: int = Field(description="Constraints that others imply.")
    ideal_redundant: int = Field(description="The same without any clearance.")
    residual: float = Field(description="What loops miss by as they are put together, m or rad.")
    pose: dict[str, tuple[float, float, float]] = Field(
        description="Centre of mass, m, and angle, rad, of each body at t = 0."
    )
    given: list[GivenStart] = Field(description="All that `start` gives, and what is taken.")
    assemblies: list[dict[str, float]] = Field(
        description="Angles of all bodies, rad, in each way to put them together; the first is run."
    )
    positions: list[dict[str, tuple[float, float]]] = Field(
        description="Centres of mass of all bodies, m, in each of them."
    )
    starts: list[dict[str, Any]] = Field(
        description="A `start` with which each of them is taken, to be pasted into the scene."
    )
    held: list[str] = Field(description="Coordinates that were held, as it moves freely.")
    period: float | None = in_unit("s", "Period of the drivers; null if there is none.")
    channels: int | None = Field(description="Number of channels; null if it cannot be run.")
    turn: DriversTurn | None = Field(description="Whether it turns through; null: not driven.")
    overshoots: list[Overshoot] = Field(
        description="Smooth tables that pass the values they are given."
    )
    replaced: list[ReplacedNumber] = Field(
        description="Numbers of the document in whose place defaults of its parameters stand."
    )
    hints: list[Hint] = Field(
        description="What is allowed and may be meant otherwise, such as a spring without a free"
        " length."
    )
    problems: list[ErrorDetail]


def scene_checker() -> SceneProcess:
    """Return the process that checks and draws scenes."""
    return SceneProcess("jointplay.service.scenes", _PATIENCE)


SceneChecker = Annotated[SceneProcess, of_the_application("scene_checker")]
DrawingQuery = create_model("DrawingQuery", __config__={"extra": "forbid"}, **PAGE_FIELDS)


@router.post(
    "/check",
    openapi_extra={"requestBody": _BODY},
    responses=_REFUSALS,
)
def check_scene(body: JobBody, checker: SceneChecker) -> SceneFindings:
    """Tell whether a scene can be put together and move: freedom, redundancy, assemblies.

    A scene that cannot be read is refused; one that cannot be run is answered with `problems`.
    """
    found = checker.ask(body, None, {})
    shown = [{"pointer": clipped(place), "detail": text} for place, text in found["problems"]]
    return SceneFindings.model_validate(found | {"problems": shown})


@router.post(
    "/drawing.{form}",
    response_class=Response,
    openapi_extra={"requestBody": _BODY},
    responses=_DRAWN | _REFUSALS | problems(kinds.UNKNOWN_FIGURE, kinds.NOT_DRAWABLE),
)
def draw_scene(
    body: JobBody,
    checker: SceneChecker,
    form: Annotated[str, Path(description="File type: png, svg, pdf or eps.")],
    query: Annotated[DrawingQuery, Query()],
) -> Response:
    """Draw a scene as it stands at t = 0, as far as it can be put together."""
    if form not in FORMS:
        sentence = f"Scenes are drawn as {IN_WORDS}, not as {clipped(form)!r}."
        raise RequestRefused.of_parameter("form", sentence, kinds.UNKNOWN_FIGURE)
    page = {name: getattr(query, name) for name in OPTIONS}
    return Response(checker.ask(body, form, page), media_type=MEDIA_TYPES[form])
