"""From a document to a queued job."""

from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds import Admission, Study, admit, parse
from jointplay.solver.kinds.compilation import check_compilation
from jointplay.solver.kinds.limits import check_room
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings

REQUEST_BODY: dict[str, Any] = {
    "required": True,
    "description": "What to compute, by its kind; all values in SI units.",
    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/JobDocument"}}},
}
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


def checked(document: object, settings: Settings, now: float) -> tuple[NewJob, bool]:
    """Check a job's document. Returns what the catalogue takes, and whether to reuse a result.

    `now` : the catalogue's time, by which jobs expire, epoch seconds.

    Raises
    ------
    InvalidInput
        With every field that is wrong.
    LimitExceeded
        The job is sound but too large, or takes too long to compile.
    """
    expires = None if settings.keep is None else now + settings.keep
    cache: object = True
    problems = []
    if isinstance(document, dict) and FIELDS.keys() & document.keys():
        cache = document.get("cache", True)
        if not isinstance(cache, bool):
            problems.append(Problem("/cache", "'cache' is true or false."))
        if document.get("expires") is not None:
            expires = _to_come(document["expires"], now)
            if expires is None:
                sentence = (
                    "'expires' is a moment to come, before the year 10000 in UTC, in RFC 3339 with"
                    " its offset, such as "
                    f"{datetime.now(UTC).year + 1}-01-01T00:00:00Z."
                )
                problems.append(Problem("/expires", sentence))
        document = {name: value for name, value in document.items() if name not in FIELDS}
    try:
        new = _within_limits(admit(document), settings, expires)
    except InvalidInput as error:
        if not problems:
            raise
        raise InvalidInput([*problems, *error.problems]) from None
    if problems:
        raise InvalidInput(problems)
    return new, cache is True


def repeated(document: dict[str, Any], settings: Settings, now: float) -> NewJob:
    """Return what the catalogue takes to compute a stored job again; raises what `checked` does.

    An earlier version may have admitted what is refused today: it is repeated as it was.
    """
    expires = None if settings.keep is None else now + settings.keep
    try:
        admission = parse(document)
    except (InvalidInput, KeyError):  # of a version whose documents this one cannot read
        return checked(document, settings, now)[0]
    return _within_limits(admission, settings, expires)


def kept_like(new: NewJob, lifetime: float | None, now: float) -> NewJob:
    """Return a job that repeats another and is kept for as long as that one was to be.

    `lifetime` : of the other, s; None: it does not expire, and the service decides.
    """
    return new if lifetime is None else replace(new, expires=now + lifetime)


def _within_limits(
    admission: Admission | Study, settings: Settings, expires: float | None
) -> NewJob:
    """Return what the catalogue takes; LimitExceeded if it is too much for this service."""
    check_compilation(admission, settings.longest_compilation)
    check_room(admission, settings.object_store.largest)
    scene = admission.job["scene"]
    return NewJob(
        kind=admission.job["kind"],
        label=admission.job["label"] or None,
        spec=admission.job,
        digest=admission.digest,
        solver_version=SOLVER_VERSION,
        scene=scene.get("preset") or scene.get("name"),
        expires=expires,
        blocks=admission.blocks if isinstance(admission, Study) else ((0, 1),),
        seal=isinstance(admission, Study),
    )


def _to_come(text: object, now: float) -> float | None:
    """Return the epoch seconds of a moment after `now`; None where the text means none."""
    try:
        moment = datetime.fromisoformat(text) if isinstance(text, str) else None
        if moment is None or moment.tzinfo is None:
            return None
        to_come = moment.astimezone(UTC).timestamp()  # an offset may lead beyond the year 9999
    except (ValueError, OverflowError):
        return None
    return to_come if to_come > now else None
