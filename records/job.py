"""A job's id and progress, and the error that ended it."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, Literal, Self

ErrorClass = Literal["user", "solver", "platform", "limit"]
"""Remedy: another document (user), another tolerance or method (solver), the operator (platform),
a smaller job (limit)."""


_JOB_ID: Final = re.compile("[0-9A-HJKMNP-TV-Z]{26}")


def is_job_id(text: str) -> bool:
    """Tell whether a text is written as the ids of jobs and batches are: they sort by time."""
    return _JOB_ID.fullmatch(text) is not None


@dataclass(frozen=True)
class JobError:
    """Reason for which a job failed."""

    error_class: ErrorClass
    code: str
    """The reason for programs, for example ``step-size-underflow``."""
    detail: str
    """The reason, and what to try, as a sentence."""
    time: float | None = None
    """Simulated time at which it happened [s]; None where that means nothing."""

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> Self:
        """Read what `document` wrote."""
        return cls(document["class"], *(document[name] for name in ("code", "detail", "time")))

    def document(self) -> dict[str, Any]:
        """Return it as JSON has it, everywhere; ``class`` is a keyword of Python."""
        return {
            "class": self.error_class,
            "code": self.code,
            "detail": self.detail,
            "time": self.time,
        }


@dataclass(frozen=True)
class Progress:
    """Progress of a job."""

    time: float
    """Simulated time reached [s]; 0 for studies."""
    fraction: float
    """Part of the whole job, 0..1."""
    steps: int | None = None
    """Accepted steps of the solver, as far as they are known."""
