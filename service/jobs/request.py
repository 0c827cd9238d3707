"""Fields of a request beside its job: whether an earlier result will do, how long to keep it."""

from datetime import UTC, datetime
from typing import Any, NamedTuple

from jointplay.records.failure import Problem

FIELDS: dict[str, dict[str, Any]] = {
    "cache": {
        "type": "boolean",
        "default": True,
        "description": "Whether an identical job that is queued, running or succeeded will do; "
        "labels do not matter. Jobs of a batch are always its own.",
    },
    "expires": {
        "anyOf": [{"type": "string", "format": "date-time"}, {"type": "null"}],
        "description": "When the job and its results may be removed, RFC 3339 with an offset. "
        "Default: as the service is set up, at first never.",
    },
}
"""The schemas of the fields that a document may have beside those of its job."""


class Wishes(NamedTuple):
    """Fields of a request beside the job."""

    cache: bool = True
    expires: float | None = None  # epoch seconds


def take(document: object, default_expires: float | None) -> tuple[object, Wishes, list[Problem]]:
    """Return a document without these fields, what they say, and what is wrong with them."""
    if not isinstance(document, dict) or not FIELDS.keys() & document.keys():
        return document, Wishes(expires=default_expires), []
    rest = {name: value for name, value in document.items() if name not in FIELDS}
    problems = []
    cache = document.get("cache", True)
    if not isinstance(cache, bool):
        problems.append(Problem("/cache", "'cache' is true or false."))
    expires = default_expires
    if document.get("expires") is not None:
        expires = _moment(document["expires"])
        if expires is None:
            sentence = (
                "'expires' is a moment to come, in RFC 3339 with its offset, such as "
                f"{datetime.now(UTC).year + 1}-01-01T00:00:00Z."
            )
            problems.append(Problem("/expires", sentence))
    return rest, Wishes(cache is True, expires), problems


def _moment(text: object) -> float | None:
    if not isinstance(text, str):
        return None
    try:
        moment = datetime.fromisoformat(text)
        if moment.tzinfo is None or moment <= datetime.now(UTC):
            return None
        return moment.timestamp()
    except (ValueError, OverflowError):
        return None
