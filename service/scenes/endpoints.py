"""``/v1/scenes``: the preset mechanisms that a job can name."""

from typing import Annotated, Any

from fastapi import APIRouter, Path
from pydantic import BaseModel, Field

from jointplay.records.failure import InvalidInput
from jointplay.service.problems import RequestRefused, clipped, kinds, problems
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Parameter, Scene

router = APIRouter(prefix="/v1/scenes", tags=["scenes"])


class SceneSummary(BaseModel):
    """One preset, and what can be set in it."""

    name: str
    description: str
    source: str = Field(description="Where the mechanism is published.")
    parameters: dict[str, Parameter]
    link: str = Field(description="Address of the whole scene document.")


class SceneList(BaseModel):
    """All presets."""

    scenes: list[SceneSummary]


@router.get("")
def list_scenes() -> SceneList:
    """List the presets with their parameters: unit, default, range, and what each does."""
    return SceneList(scenes=[_summary(name) for name in presets.names()])


@router.get("/{name}", response_model_exclude_unset=True, responses=problems(kinds.UNKNOWN_SCENE))
def show_scene(name: Annotated[str, Path(description="Name of a preset.")]) -> Scene:
    """Show a preset's scene document: a start for a mechanism of one's own."""
    return Scene.model_validate(_document(name))


def _document(name: str) -> dict[str, Any]:
    try:
        return presets.document(name)
    except InvalidInput as error:
        sentence = clipped(error.problems[0].detail)
        raise RequestRefused.of_parameter("name", sentence, kinds.UNKNOWN_SCENE) from None


def _summary(name: str) -> SceneSummary:
    scene = Scene.model_validate(presets.document(name))
    return SceneSummary.model_validate(vars(scene) | {"name": name, "link": f"/v1/scenes/{name}"})
