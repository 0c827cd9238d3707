"""``/v1/scenes/channels``: channels of a scene, and where its sections may be taken."""

from typing import Annotated, Any

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.body import JobBody
from jointplay.service.fields import in_unit
from jointplay.service.problems import kinds, problems
from jointplay.service.scenes.poses import Poser, body_of
from jointplay.service.scenes.posing import ChannelsQuestion

router = APIRouter(prefix="/v1/scenes", tags=["scenes"])


class OfferedChannel(BaseModel):
    """A channel of a scene."""

    name: str
    unit: str
    help: str


class SceneChannels(BaseModel):
    """Channels of a scene and its contacts, and sections that suit it."""

    scene: str
    channels: list[OfferedChannel]
    contacts: list[str] = Field(
        description="Joints that have a clearance, also one of 0; of one with several contacts each"
        " of them."
    )
    period: float = in_unit(
        "s", "What counts as a period: that of the drivers, else the scene's own time scale."
    )
    sections: Annotated[
        list[dict[str, Any]],
        Field(
            description="A `section` that a study may have, of each form that suits: the most usual"
            " first."
        ),
    ]


@router.post(
    "/channels",
    openapi_extra=body_of(ChannelsQuestion),
    responses=problems(*kinds.OF_A_BODY, kinds.INVALID_REQUEST),
)
def scene_channels(body: JobBody, poser: Poser) -> SceneChannels:
    """Return the channels of a scene, and where its sections may be taken."""
    return SceneChannels.model_validate(poser.ask("channels", body))
