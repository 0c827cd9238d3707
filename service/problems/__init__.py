"""RFC 9457 problem documents: everything that the service answers instead of a result.

Here are their shape and the exception that carries one. `kinds` lists the problems that exist,
`refusals` says which one an exception of any layer becomes, `handlers` answers with it, and
`endpoints` serves the page that each problem's ``type`` points to.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from jointplay.service.problems.kinds import INVALID_REQUEST, UNAVAILABLE, ProblemKind

MEDIA_TYPE = "application/problem+json"
MOST_ERRORS = 100
"""Errors in one document; their count is in its detail."""
_LONGEST_SENTENCE = 1000  # a client's own text may be quoted in it


class ErrorDetail(BaseModel):
    """One thing that is wrong: where, and what would be right."""

    model_config = ConfigDict(frozen=True)

    detail: str = Field(description="One sentence that says what is wrong and what is right.")
    pointer: str | None = Field(
        default=None, description="JSON pointer (RFC 6901) into the body that was sent."
    )
    parameter: str | None = Field(
        default=None, description="Name of the path or query parameter that is meant."
    )


class ProblemDocument(BaseModel):
    """An RFC 9457 problem document."""

    model_config = ConfigDict(frozen=True)

    type: str = Field(description="Identifies the kind of problem and explains it when fetched.")
    title: str = Field(description="The kind of problem in a few words.")
    status: int = Field(description="HTTP status.")
    detail: str = Field(description="What happened this time.")
    instance: str | None = Field(default=None, description="Path of the request.")
    errors: tuple[ErrorDetail, ...] = Field(
        default=(), description="Every field or parameter that is wrong."
    )


class RequestRefused(Exception):
    """Raised where a request cannot be answered; becomes a problem document of ``kind``."""

    def __init__(
        self,
        kind: ProblemKind,
        detail: str,
        errors: Sequence[ErrorDetail] = (),
        headers: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(detail)
        self.kind = kind
        self.detail = detail
        self.errors = tuple(errors)
        self.headers = dict(headers or {})

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.kind, self.detail, self.errors, self.headers)

    @classmethod
    def of_parameter(
        cls,
        parameter: str,
        sentence: str,
        kind: ProblemKind = INVALID_REQUEST,
        *,
        remedy: str = "",
        headers: Mapping[str, str] | None = None,
    ) -> Self:
        """Refuse one parameter; its remedy is the sentence itself if none is given."""
        errors = [ErrorDetail(parameter=parameter, detail=clipped(remedy or sentence))]
        return cls(kind, sentence, errors, headers)


def unavailable(sentence: str, seconds: int) -> RequestRefused:
    """Return the refusal of what can be done again after some seconds."""
    return RequestRefused(UNAVAILABLE, sentence, headers={"Retry-After": str(seconds)})


def clipped(text: str) -> str:
    """Return ``text``, shortened where a client's own text made it endless."""
    if len(text) <= _LONGEST_SENTENCE:
        return text
    return text[: _LONGEST_SENTENCE - 1] + "…"


def problems(*kinds: ProblemKind) -> dict[int | str, dict[str, Any]]:
    """Return the ``responses`` that an endpoint declares in the OpenAPI document."""
    titles: dict[int, list[str]] = {}
    for kind in kinds:
        titles.setdefault(kind.status, []).append(kind.title)
    return {
        status: {
            "description": "; ".join(lines),
            "content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/ProblemDocument"}}},
        }
        | _HEADERS.get(status, {})
        for status, lines in titles.items()
    }


def header(description: str, *, always: bool = True) -> dict[str, Any]:
    """Return how the OpenAPI document describes a header of an answer."""
    return {"description": description, "required": always, "schema": {"type": "string"}}


_AGAIN = header("Seconds after which to ask again.", always=False)
_HEADERS: dict[int, dict[str, Any]] = {
    401: {"headers": {"WWW-Authenticate": header("`Bearer`.")}},
    409: {"headers": {"Retry-After": _AGAIN}},
    416: {"headers": {"Content-Range": header("`bytes */` and the size.")}},
    429: {"headers": {"Retry-After": header("Seconds after which to ask again.")}},
    503: {"headers": {"Retry-After": header("Seconds after which to ask again.")}},
}
"""Headers of the problems that have a status."""
