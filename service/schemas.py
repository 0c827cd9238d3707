"""``/v1/schemas``: JSON Schemas of documents that clients write."""

from typing import Any

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from jointplay.solver.scene.schema import scene_schema

router = APIRouter(prefix="/v1/schemas", tags=["scenes"])
MEDIA_TYPE = "application/schema+json"


class SchemaResponse(JSONResponse):
    """A JSON Schema, whose media type says that it is one."""

    media_type = MEDIA_TYPE


@router.get("/scene.json", response_class=SchemaResponse)
def show_scene_schema() -> dict[str, Any]:
    """Show the JSON Schema of a scene: every field with its type, range and unit."""
    return scene_schema()
