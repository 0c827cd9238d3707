"""The OpenAPI document: what FastAPI derives, plus the bodies' schemas and our kind of errors."""

from collections.abc import Callable
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic import TypeAdapter

from jointplay.service.batches.admission import BatchDocument
from jointplay.service.jobs.submission import FIELDS
from jointplay.service.problems.document import ProblemDocument, problems
from jointplay.service.problems.kinds import INVALID_REQUEST
from jointplay.solver.kinds import KINDS, any_job

_REFERENCE = "#/components/schemas/{model}"


def described(app: FastAPI) -> Callable[[], dict[str, Any]]:
    """Return the function that makes the document once, when it is first asked for."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            document = get_openapi(
                title=app.title,
                version=app.version,
                description=app.description,
                routes=app.routes,
            )
            _add_schemas(document["components"]["schemas"])
            _replace_fastapi_errors(document)
            app.openapi_schema = document
        return app.openapi_schema

    return openapi


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
    problem = problems(INVALID_REQUEST)[INVALID_REQUEST.status]
    for operations in document["paths"].values():
        for operation in operations.values():
            responses = operation["responses"]
            if "HTTPValidationError" in str(responses.get("422")):
                responses["422"] = problem
    for name in ("HTTPValidationError", "ValidationError"):
        document["components"]["schemas"].pop(name, None)
