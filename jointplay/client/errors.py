"""Errors between client and service: one class for each remedy."""

from collections.abc import Sequence
from typing import NamedTuple


class FieldProblem(NamedTuple):
    """One refused field: its place (JSON pointer or name of a parameter) and a sentence."""

    place: str
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
    """The service takes no more for now (429 or 503), also when asked several times."""


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

    def __init__(
        self, detail: str, *, status: int, problem: str, fields: Sequence[FieldProblem] = ()
    ) -> None:
        super().__init__(detail)
        self.status = status
        self.problem = problem
        self.fields = tuple(fields)

    def __str__(self) -> str:
        if not self.fields:
            return str(self.args[0])
        return "; ".join(
            f"{field.place}: {field.detail}" if field.place else field.detail
            for field in self.fields
        )


class NotAllowed(Refused):
    """The API key is missing, wrong, or not meant for this (401 or 403)."""


class NotFound(Refused):
    """No such job, scene, figure or result (404)."""


class Expired(Refused):
    """The job was deleted or has expired, and its results with it (410)."""


class ResultsNotReady(Refused):
    """The job exists, but there are no results yet (409)."""


class NotFinished(Refused):
    """The job is not finished, so it cannot be deleted yet: cancel it, or wait (409)."""


class TimedOut(ClientError):
    """Waiting took too long; the job goes on."""
