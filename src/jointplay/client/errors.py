"""Errors between client and service: one class for each remedy."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Final, NamedTuple

if TYPE_CHECKING:
    import httpx


class FieldProblem(NamedTuple):
    """One refused field: its JSON pointer, or the name of a parameter, and a sentence."""

    pointer: str
    detail: str


class ClientError(Exception):
    """Base of everything that `jointplay.client` raises."""


class Unreachable(ClientError):
    """Nothing answers at the address, or the connection broke."""


class MissingExtra(ClientError):
    """A package is not installed that this needs: ``pip install 'jointplay[xarray]'``."""


class ServiceFailure(ClientError):
    """The service answered, but could not do its work (5xx): see its log, try again later."""


class Overloaded(ServiceFailure):
    """The service takes no more for now (429, 503 or 507), also when asked several times."""


class Refused(ClientError):
    """The request is wrong (4xx): correct the fields that ``fields`` names.

    Attributes
    ----------
    status
        HTTP status.
    problem
        Last part of the problem's ``type``, for example ``"invalid-job"``.
    fields
        The refused fields, empty when the problem is not about a field.
    """

    _usual: ClassVar = (422, "invalid-request")
    """Status and problem where nothing else is said."""

    def __init__(
        self,
        detail: str,
        *,
        status: int | None = None,
        problem: str | None = None,
        fields: Sequence[FieldProblem] = (),
    ) -> None:
        super().__init__(detail)
        self.status = self._usual[0] if status is None else status
        self.problem = self._usual[1] if problem is None else problem
        self.fields = tuple(fields)

    def __str__(self) -> str:
        if not self.fields:
            return str(self.args[0])
        return "; ".join(
            f"{field.pointer}: {field.detail}" if field.pointer else field.detail
            for field in self.fields
        )


class NotAllowed(Refused):
    """The API key is missing, wrong, or not meant for this (401 or 403)."""


class NotFound(Refused):
    """No such job, scene, figure or result (404)."""

    _usual = (404, "no-results")


class Expired(Refused):
    """The job was deleted or has expired, and its results with it (410)."""


class Damaged(Refused):
    """Files of the job's results are not what was stored: submit its document again (410)."""

    _usual = (410, "damaged-results")


class ResultsNotReady(Refused):
    """The job exists, but there are no results yet (409)."""

    _usual = (409, "results-not-ready")


class NotFinished(Refused):
    """The job is not finished, so it cannot be deleted yet: cancel it, or wait (409)."""


class TimedOut(ClientError):
    """Waiting took too long; the job goes on."""


OVERLOADED: Final = frozenset({429, 503, 507})
"""Statuses of a service that asks for the same request later."""
_BY_PROBLEM = {
    "not-finished": NotFinished,
    "results-not-ready": ResultsNotReady,
    "damaged-results": Damaged,
}
_BY_STATUS = {401: NotAllowed, 403: NotAllowed, 404: NotFound, 410: Expired}


def error_from(response: "httpx.Response") -> ClientError:
    """Return the exception for an answer of 300 or more."""
    status = response.status_code
    problem = _problem_in(response)
    detail = str(problem.get("detail") or problem.get("title") or response.reason_phrase)
    if status in OVERLOADED:
        return Overloaded(f"The service takes no more for now ({status}): {detail}")
    if status >= 500:
        return ServiceFailure(f"The service failed with {status}: {detail}")
    name = str(problem.get("type", "")).rsplit("/", 1)[-1]
    kind = _BY_PROBLEM.get(name) or _BY_STATUS.get(status, Refused)
    told = problem.get("errors")
    fields = [
        FieldProblem(str(one.get("pointer") or one.get("parameter") or ""), str(one["detail"]))
        for one in (told if isinstance(told, list) else ())
        if isinstance(one, dict) and "detail" in one
    ]
    return kind(detail, status=status, problem=name, fields=fields)


def _problem_in(response: "httpx.Response") -> dict[str, Any]:
    """Return the problem document, or an empty one when something else answered (a proxy)."""
    if response.headers.get("content-type", "").startswith("application/problem+json"):
        try:
            document = response.json()
        except (ValueError, RecursionError):
            return {}
        if isinstance(document, dict):
            return document
    return {}
