"""Large answers as JSON."""

from fastapi import Response
from pydantic import BaseModel


def as_json(document: BaseModel) -> Response:
    """Serialise once, without validating a million numbers of our own; NaN becomes null."""
    return Response(document.model_dump_json(), media_type="application/json")
