"""``/v1/scenes/poses`` and ``/v1/scenes/drag``: how a scene stands and moves, before it is run."""

from typing import Annotated, Any

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.body import JobBody
from jointplay.service.dependencies import of_the_application
from jointplay.service.fields import in_unit
from jointplay.service.problems import kinds, problems
from jointplay.service.scenes.posing import DragQuestion, PosesQuestion
from jointplay.service.scenes.process import SceneProcess

router = APIRouter(prefix="/v1/scenes", tags=["scenes"])
_PATIENCE = 20.0  # s; 512 poses of a chain of 30 bodies take half of them
_REFUSALS = problems(*kinds.OF_A_BODY, kinds.INVALID_REQUEST)

Pose = Annotated[
    dict[str, tuple[float, float, float]],
    Field(description="By body: centre of mass x, y (m) and angle theta (rad)."),
]


class Stop(BaseModel):
    """Where the drivers cannot go on, with the clearances closed."""

    time: float = in_unit("s")
    detail: str


class Curve(BaseModel):
    """A curve that a joint is drawn by; it moves with a body."""

    joint: str
    about: str = Field(description="Point of the body, body.point.")
    filled: bool = Field(description="Whether it is the outline of something.")
    points: list[tuple[float, float]] = in_unit("m", "From that point, in the body's axes.")


class Poses(BaseModel):
    """Poses of a scene at t = 0 and as its drivers go on, its clearances closed."""

    scene: str
    times: list[float] = in_unit("s", "Those asked for, up to where the drivers stop.")
    poses: list[Pose] = Field(description="One an instant.")
    curves: list[Curve] = Field(description="Outlines of cams, and what else joints are drawn by.")
    residual: float = Field(description="What loops miss by as they are put together, m or rad.")
    drivers_time: float | None = in_unit(
        "s",
        "Time in which the drivers come round together, or else the slowest turns once or shows its"
        " motion, at most 20 times that of the quickest; null if nothing is driven.",
    )
    repeats: bool = Field(description="Whether all drivers are back after it.")
    stopped: Stop | None = Field(description="Null if they go on through all times.")


class DraggedPose(BaseModel):
    """A pose in which a point is as near to a position as the joints let it come."""

    scene: str
    pose: Pose


def scene_poser() -> SceneProcess:
    """Return the process that poses scenes: checks of others do not keep it waiting."""
    return SceneProcess("jointplay.service.scenes.posing", _PATIENCE)


def body_of(model: type[BaseModel]) -> dict[str, Any]:
    """Return how the body of a request is described that has the fields of a model."""
    content = {"application/json": {"schema": model.model_json_schema()}}
    return {"requestBody": {"required": True, "content": content}}


Poser = Annotated[SceneProcess, of_the_application("poser")]


@router.post(
    "/poses",
    openapi_extra=body_of(PosesQuestion),
    responses=_REFUSALS,
)
def pose_scene(body: JobBody, poser: Poser) -> Poses:
    """Return where the bodies of a scene are, at t = 0 and as its drivers go on.

    Clearances are closed, as the solver closes them to put a scene together; what no driver moves
    is carried along, as little as the joints need.
    """
    return Poses.model_validate(poser.ask("poses", body))


@router.post(
    "/drag",
    openapi_extra=body_of(DragQuestion),
    responses=_REFUSALS,
)
def drag_point(body: JobBody, poser: Poser) -> DraggedPose:
    """Pull a point of a body to a position; drivers let go, and clearances are closed."""
    return DraggedPose.model_validate(poser.ask("drag", body))
