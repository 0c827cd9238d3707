"""Checking what is submitted: short documents at once, all others in processes of their own.

What is long, or has many bodies, would hold up every other request, and the memory that it takes,
or that a kind of job loads, would never be given back. Those processes can be ended, and end by
themselves when idle.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, TypeVar, cast

from jointplay.records.failure import LimitExceeded
from jointplay.records.strict_json import parse
from jointplay.service.answering import AnsweringProcess, refusing
from jointplay.service.jobs.submission import checked, repeated
from jointplay.service.problems import RequestRefused
from jointplay.solver.kernels.trace.length import SURELY_SHORT
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings

SHORT = 32 * 1024
"""Bytes that are parsed within a millisecond."""
FEW: Final = 100_000
"""Points that are looked at within a fifth of a second, in 30 MB: a map may have millions,
which take seconds and a gigabyte."""
_COUNTS: Final = ("count", "samples", "members", "starts")
_MODULE = "jointplay.service.checking"

Answer = TypeVar("Answer")
Check = Callable[[object, Settings, Catalogue], Answer]
"""Takes a document, settings and the catalogue; another process can be sent it and its answer."""


@dataclass(frozen=True)
class Checked:
    """A job that can be computed."""

    job: NewJob
    reuse: bool
    """Whether an identical job will do."""


@dataclass(frozen=True)
class RepeatJob:
    """The check of a stored job that is computed again; raises what `repeated` does."""

    def __call__(self, document: object, settings: Settings, catalogue: Catalogue) -> NewJob:
        """Check a document that was filled in."""
        return repeated(cast("dict[str, Any]", document), settings, catalogue.clock())


@dataclass(frozen=True)
class CheckJob:
    """The check of one job; raises what `checked` does."""

    def __call__(self, document: object, settings: Settings, catalogue: Catalogue) -> Checked:
        """Check a document."""
        return Checked(*checked(document, settings, catalogue.clock()))


class Checker:
    """Has documents checked where they are best checked, each kind of check in its turn.

    A batch of 10 000 jobs takes half a minute, which single jobs do not wait for.

    Parameters
    ----------
    patience
        Seconds for one job; all else may take ten times as long.
    """

    def __init__(self, settings: Settings, catalogue: Catalogue, patience: float = 60.0) -> None:
        self._settings = settings
        self._catalogue = catalogue
        self._jobs = AnsweringProcess(_MODULE, patience)
        self._others = AnsweringProcess(_MODULE, 10 * patience)

    def check(self, what: Check[Answer], body: bytes) -> Answer:
        """Return what a check finds of a document.

        Raises
        ------
        MalformedJson, InvalidInput, LimitExceeded, RequestRefused
            It is wrong, takes too long to check, or too many are being checked (503).
        """
        if len(body) <= SHORT:
            document = parse(body)
            if not _takes_much(document):
                return what(document, self._settings, self._catalogue)
        process = self._jobs if isinstance(what, CheckJob | RepeatJob) else self._others
        too_slow = f"Checking this takes more than {process.patience:g} s; send a smaller one."
        with refusing(
            "Many large documents are being checked; send it again in a moment.",
            LimitExceeded.at("", too_slow),
            "The document could not be checked.",
        ):
            answer = process.answer((what, body, self._settings))
        if isinstance(answer, RequestRefused):
            raise answer
        return cast("Answer", answer)

    def close(self) -> None:
        """End the processes."""
        self._jobs.close()
        self._others.close()


def _takes_much(document: object) -> bool:
    """Whether much is loaded or looked at, or equations are recorded, as they may be too long."""
    if not isinstance(document, dict):
        return False
    jobs = document.get("jobs")
    if isinstance(jobs, list):
        return any(_takes_much(job) for job in jobs)
    kind, scene = document.get("kind"), document.get("scene")
    if isinstance(kind, str) and kind in KINDS and KINDS[kind].loads_much:
        return True
    if _points({name: value for name, value in document.items() if name != "scene"}) > FEW:
        return True
    bodies = scene.get("bodies") if isinstance(scene, dict) else None
    return isinstance(bodies, dict) and len(bodies) > SURELY_SHORT


def _points(value: object) -> int:
    """Return how many points a study has at most, by the lengths of all axes that it names."""
    if isinstance(value, list):
        return max(len(value), 1) if value and not isinstance(value[0], str) else 1
    if not isinstance(value, dict):
        return 1
    found = 1
    for name, inner in value.items():
        if name in _COUNTS and isinstance(inner, int):
            found *= max(inner, 1)
        else:
            found *= _points(inner)
    return found
