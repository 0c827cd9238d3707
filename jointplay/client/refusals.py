"""From an answer that is an error to a typed exception."""

from typing import Any, Final

import httpx

from jointplay.client.errors import (
    ClientError,
    Expired,
    FieldProblem,
    NotAllowed,
    NotFinished,
    NotFound,
    Overloaded,
    Refused,
    ResultsNotReady,
    ServiceFailure,
)

_BY_PROBLEM: Final[dict[str, type[Refused]]] = {
    "not-finished": NotFinished,
    "results-not-ready": ResultsNotReady,
}
_BY_STATUS: Final[dict[int, type[Refused]]] = {
    401: NotAllowed,
    403: NotAllowed,
    404: NotFound,
    410: Expired,
}


def error_from(response: httpx.Response) -> ClientError:
    """Return the exception for an answer of 300 or more."""
    status = response.status_code
    problem = _problem_in(response)
    detail = str(problem.get("detail") or problem.get("title") or response.reason_phrase)
    if status in (429, 503):
        return Overloaded(f"The service takes no more for now ({status}): {detail}")
    if status >= 500:
        return ServiceFailure(f"The service failed with {status}: {detail}")
    name = str(problem.get("type", "")).rsplit("/", 1)[-1]
    kind = _BY_PROBLEM.get(name) or _BY_STATUS.get(status, Refused)
    fields = [
        FieldProblem(str(one.get("pointer") or one.get("parameter") or ""), one["detail"])
        for one in problem.get("errors") or ()
    ]
    return kind(detail, status=status, problem=name, fields=fields)


def _problem_in(response: httpx.Response) -> dict[str, Any]:
    """Return the problem document, or an empty one when something else answered (a proxy)."""
    if response.headers.get("content-type", "").startswith("application/problem+json"):
        document = response.json()
        if isinstance(document, dict):
            return document
    return {}
