"""The OpenAPI document: what FastAPI derives, plus bodies' schemas and our kind of errors."""

import asyncio
import json
from functools import cache
from typing import Any

from anyio import to_thread
from fastapi import FastAPI, Response
from fastapi.openapi.utils import get_openapi
from pydantic import TypeAdapter

from jointplay.service import problems
from jointplay.service.batches.admission import BatchDocument
from jointplay.service.jobs.submission import FIELDS
from jointplay.service.problems import ProblemDocument
from jointplay.service.problems.kinds import INVALID_REQUEST
from jointplay.solver.kinds import KINDS, any_job

_REFERENCE = "#/components/schemas/{model}"


def describe(app: FastAPI) -> None:
    """Let an application serve its description, which is made once: it takes a second."""
    one_after_another = asyncio.Lock()

    @cache
    def document() -> dict[str, Any]:
        return _described(app)

    @cache
    def written() -> bytes:
        return json.dumps(document(), ensure_ascii=False, separators=(",", ":")).encode()

    @app.get("/openapi.json", include_in_schema=False)
    async def show_description() -> Response:
        async with one_after_another:
            found = await to_thread.run_sync(written)
        return Response(found, media_type="application/json")

    app.openapi = document  # type: ignore[method-assign]  # as FastAPI documents it


def _described(app: FastAPI) -> dict[str, Any]:
    document = get_openapi(
        title=app.title, version=app.version, description=app.description, routes=app.routes
    )
    _add_schemas(document["components"]["schemas"])
    _replace_fastapi_errors(document)
    return document


def _add_schemas(schemas: dict[str, Any]) -> None:
    """Add what no endpoint's signature mentions: bodies that we parse, and problems."""
    unmentioned = {
        "JobDocument": any_job(),
        "BatchDocument": BatchDocument,
        "ProblemDocument": ProblemDocument,
    }
    for name, described_type in unmentioned.items():
        schema = TypeAdapter(described_type).json_schema(ref_template=_REFERENCE)
        for part, definition in schema.pop("$defs", {}).items():
            schemas.setdefault(part, definition)
        schemas[name] = schema
    for kind in KINDS.values():
        schemas[kind.document.__name__]["properties"] |= FIELDS
    # its model takes them as they are: admission checks one after the other
    schemas["BatchDocument"]["properties"]["jobs"]["items"] = {
        "$ref": _REFERENCE.format(model="JobDocument")
    }


def _replace_fastapi_errors(document: dict[str, Any]) -> None:
    """FastAPI announces its own 422 wherever there are parameters; we answer with a problem."""
    problem = problems.problems(INVALID_REQUEST)[INVALID_REQUEST.status]
    for operations in document["paths"].values():
        for operation in operations.values():
            responses = operation["responses"]
            if "HTTPValidationError" in str(responses.get("422")):
                responses["422"] = problem
    for name in ("HTTPValidationError", "ValidationError"):
        document["components"]["schemas"].pop(name, None)
