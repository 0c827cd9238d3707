"""From the exceptions of every layer to problem documents: the only place that knows both."""

import logging
from functools import cache, singledispatch

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from fastapi.routing import iter_route_contexts
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.routing import compile_path

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.records.strict_json import MalformedJson
from jointplay.service.access.signed import PREFIX
from jointplay.service.problems import (
    MEDIA_TYPE,
    ErrorDetail,
    ProblemDocument,
    RequestRefused,
    clipped,
    kinds,
)
from jointplay.service.problems.repeated import Repeated
from jointplay.storage.catalogue.errors import (
    BatchNotFinished,
    BatchNotFound,
    Fenced,
    JobNotFinished,
    KeyReused,
    QuotaExceeded,
    Unavailable,
)
from jointplay.worker.handed_in.results import NotTheJobs

_log = logging.getLogger(__name__)
_MOST_ERRORS = 100  # in one document; their count is in its detail
_REPEATED = Repeated()
_compiled = cache(compile_path)
_BY_STATUS = {404: kinds.NOT_FOUND, 405: kinds.METHOD_NOT_ALLOWED}


def install(app: FastAPI) -> None:
    """Let ``app`` answer every exception with a problem document."""
    for answered in {*refusal.registry, Exception} - {object}:
        app.add_exception_handler(answered, answer)


async def answer(request: Request, error: Exception) -> Response:
    """Answer a request that failed with the problem document of its error."""
    refused = refusal(error)
    if refused.kind is kinds.METHOD_NOT_ALLOWED:
        known = _methods_at(request).union(refused.headers.get("Allow", "").split(", "))
        refused.headers["Allow"] = ", ".join(sorted(known - {""}))
    if refused.kind.status >= 500:
        _tell(request, refused, error)
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


def _tell(request: Request, refused: RequestRefused, error: Exception) -> None:
    path = request.url.path
    if path.startswith(PREFIX):
        path = f"{PREFIX}..."  # what is behind it opens a job's results
    asked = f"{request.method} {path}"
    if refused.kind is kinds.INTERNAL:
        _log.error("%s failed", asked, exc_info=error)
        return
    left_out = _REPEATED.count(refused.detail)
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


@singledispatch
def refusal(error: Exception) -> RequestRefused:
    """Return the answer to an exception; this one is of no known kind."""
    return RequestRefused(kinds.INTERNAL, "The service failed; its log says why.")


@refusal.register
def _(error: RequestRefused) -> RequestRefused:
    return error


@refusal.register
def _(error: RequestValidationError) -> RequestRefused:
    """Name the parameters; the input is not echoed, as JSON could not carry all of it."""
    errors = [
        ErrorDetail(parameter=clipped(str(one["loc"][-1])), detail=_sentence(one["msg"]))
        for one in error.errors()
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


@refusal.register
def _(error: MalformedJson) -> RequestRefused:
    errors = [ErrorDetail(pointer=clipped(f.pointer), detail=f.detail) for f in error.flaws]
    return RequestRefused(kinds.MALFORMED_JSON, errors[0].detail, errors)


@refusal.register
def _(error: InvalidInput) -> RequestRefused:
    kind = kinds.LIMIT_EXCEEDED if isinstance(error, LimitExceeded) else kinds.INVALID_JOB
    errors = [
        ErrorDetail(pointer=clipped(one.pointer), detail=clipped(one.detail))
        for one in error.problems[:_MOST_ERRORS]
    ]
    count = len(error.problems)
    detail = errors[0].detail if count == 1 else f"{count} fields are wrong."
    return RequestRefused(kind, detail, errors)


@refusal.register
def _(error: Unavailable) -> RequestRefused:
    kind = kinds.DISK_FULL if error.full else kinds.UNAVAILABLE
    detail = f"T{str(error)[1:]}; nothing was recorded."
    return RequestRefused(kind, detail, headers={"Retry-After": "5"})


@refusal.register
def _(error: ConnectionError) -> RequestRefused:
    """Another server that answers are made of, such as that of the results, is away."""
    detail = "The results cannot be reached at the moment; they are not lost."
    return RequestRefused(kinds.UNAVAILABLE, detail, headers={"Retry-After": "5"})


@refusal.register
def _(error: Fenced) -> RequestRefused:
    return RequestRefused(kinds.NOT_HELD, f"A{str(error)[1:]}.")


@refusal.register
def _(error: NotTheJobs) -> RequestRefused:
    return RequestRefused(kinds.RESULTS_REFUSED, f"The block was taken back: {error}.")


@refusal.register
def _(error: KeyReused) -> RequestRefused:
    sentence = f"{str(error).capitalize()}."
    errors = [ErrorDetail(parameter="Idempotency-Key", detail=clipped(sentence))]
    return RequestRefused(kinds.KEY_REUSED, sentence, errors)


@refusal.register
def _(error: QuotaExceeded) -> RequestRefused:
    return RequestRefused(kinds.QUOTA_EXCEEDED, f"{error}.")


@refusal.register
def _(error: JobNotFinished) -> RequestRefused:
    return RequestRefused(kinds.NOT_FINISHED, f"J{str(error)[1:]}.")


@refusal.register
def _(error: BatchNotFinished) -> RequestRefused:
    return RequestRefused(kinds.NOT_FINISHED, f"{error}.")


@refusal.register
def _(error: BatchNotFound) -> RequestRefused:
    return RequestRefused(kinds.UNKNOWN_BATCH, f"T{str(error)[1:]}.")


def _sentence(message: str) -> str:
    sentence = message.replace("Extra inputs are not permitted", "There is no such parameter")
    return clipped(sentence.rstrip(".") + ".")
