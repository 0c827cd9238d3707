"""Problem documents for every exception that a request ends with; `refusals` says which."""

import logging
from functools import cache

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from fastapi.routing import iter_route_contexts
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.routing import compile_path

from jointplay.records.log_repetitions import Repetitions
from jointplay.service.access.signed import PREFIX
from jointplay.service.problems import (
    MEDIA_TYPE,
    MOST_ERRORS,
    ErrorDetail,
    ProblemDocument,
    RequestRefused,
    clipped,
    kinds,
)
from jointplay.service.problems.parameters import sentence
from jointplay.service.problems.refusals import refusal

_log = logging.getLogger(__name__)
_REPETITIONS = Repetitions(1.0)
"""Refusals: an attack makes thousands a second."""
_compiled = cache(compile_path)
_BY_STATUS = {404: kinds.NOT_FOUND, 405: kinds.METHOD_NOT_ALLOWED}


def install(app: FastAPI) -> None:
    """Let ``app`` answer every exception with a problem document."""
    for answered in {*refusal.registry, RequestValidationError, Exception} - {object}:
        app.add_exception_handler(answered, answer)


async def answer(request: Request, error: Exception) -> Response:
    """Answer a request that failed with the problem document of its error."""
    if isinstance(error, RequestValidationError):
        refused = _of_parameters(error, request)
    else:
        refused = refusal(error)
    if refused.kind is kinds.METHOD_NOT_ALLOWED:
        known = _methods_at(request).union(refused.headers.get("Allow", "").split(", "))
        known |= {"HEAD"} if "GET" in known else set()  # see `jointplay.service.heads`
        refused.headers["Allow"] = ", ".join(sorted(known - {""}))
    if refused.kind.status >= 500:
        _log_failure(request, refused, error)
    document = ProblemDocument(
        type=refused.kind.type,
        title=refused.kind.title,
        status=refused.kind.status,
        detail=clipped(refused.detail),
        instance=clipped(request.url.path),
        errors=refused.errors,
    )
    return Response(
        document.model_dump_json(exclude_none=True),
        status_code=refused.kind.status,
        headers=refused.headers,
        media_type=MEDIA_TYPE,
    )


def _log_failure(request: Request, refused: RequestRefused, error: Exception) -> None:
    path = request.url.path
    if path.startswith(PREFIX):
        path = f"{PREFIX}..."  # what is behind it opens a job's results
    asked = f"{request.method} {path}"
    if refused.kind is kinds.INTERNAL:
        _log.error("%s failed", asked, exc_info=error)
        return
    left_out = _REPETITIONS.left_out(refused.detail)
    if left_out is not None:
        told = f" ({left_out} others before it)" if left_out else ""
        status = refused.kind.status
        _log.warning("%s was answered with %d: %s%s", asked, status, refused.detail, told)


def _methods_at(request: Request) -> set[str]:
    """Return what all operations at an address know; its first route names only its own."""
    return {
        method
        for route in iter_route_contexts(request.app.routes)
        if _compiled(str(route.path))[0].match(request.url.path)
        for method in route.methods or ()
    }


def _of_parameters(error: RequestValidationError, request: Request) -> RequestRefused:
    """Name the parameters; the input is not echoed, as JSON could not carry all of it."""
    errors = [
        ErrorDetail(parameter=clipped(str(one["loc"][-1])), detail=sentence(one, request))
        for one in error.errors()[:MOST_ERRORS]
    ]
    names = ", ".join(str(one.parameter) for one in errors)
    return RequestRefused(kinds.INVALID_REQUEST, f"Correct the parameters: {names}.", errors)


@refusal.register
def _(error: HTTPException) -> RequestRefused:
    fallback = kinds.INVALID_REQUEST if error.status_code < 500 else kinds.INTERNAL
    kind = _BY_STATUS.get(error.status_code, fallback)
    return RequestRefused(kind, f"{kind.title}. {kind.help}", headers=error.headers)


@refusal.register
def _(_: ClientDisconnect) -> RequestRefused:
    """Nobody reads it: the client has gone before its body was here."""
    return RequestRefused(kinds.INVALID_REQUEST, "The body ended before it was whole.")
