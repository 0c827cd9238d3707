"""All jobs of a batch are checked before one of them is queued."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.records.strict_json import escaped
from jointplay.service.jobs.submission import checked, kept_like, repeated
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.quotas import Quota
from jointplay.storage.catalogue.records import NewJob, SubmissionKey, SubmittedBatch
from jointplay.storage.settings import Settings

MOST_JOBS = 10_000
LONGEST_LABEL = 200
Check = Callable[[Any, Settings, float], NewJob]
"""Takes a job's document, settings and the catalogue's time."""
_MOST_PROBLEMS = 100  # that are looked for: as many as one problem document carries


class BatchDocument(BaseModel):
    """Jobs of any kinds that are accepted or refused together."""

    model_config = ConfigDict(extra="forbid")

    jobs: list[Any] = Field(
        min_length=1,
        max_length=MOST_JOBS,
        description="The jobs, in the order in which they are queued.",
    )
    label: str = Field(
        default="", max_length=LONGEST_LABEL, description="A name of your own for the batch."
    )


@dataclass(frozen=True)
class QueueBatch:
    """The check of a batch, which is queued then: 10 000 jobs take seconds to write.

    Its key lets a process that takes the place of a lost one find what that had queued. Jobs that
    repeat others have `retries`, their ids, and `lifetimes`, s, one for each.
    """

    key: SubmissionKey
    owner: str
    quota: Quota
    retries: tuple[str, ...] = ()
    lifetimes: tuple[float | None, ...] = ()

    def __call__(
        self, document: object, settings: Settings, catalogue: Catalogue
    ) -> SubmittedBatch:
        """Check and queue a document's jobs; raises what `admit_batch` and `submit_batch` do."""
        check = repeated if self.retries else _submitted
        now = catalogue.clock()
        jobs, label = admit_batch(document, settings, check, now)
        nothing = (None,) * len(jobs)
        ended, lifetimes = self.retries or nothing, self.lifetimes or nothing
        return catalogue.submit_batch(
            [
                replace(kept_like(job, lifetime, now), owner=self.owner, retry_of=old)
                for job, old, lifetime in zip(jobs, ended, lifetimes, strict=True)
            ],
            label=label or None,
            key=self.key,
            owner=self.owner,
            quota=self.quota,
        )


def admit_batch(
    document: object, settings: Settings, check: Check, now: float
) -> tuple[list[NewJob], str]:
    """Check a batch and return its jobs, each by a check of its own, and its label.

    `now` : the catalogue's time, epoch seconds.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field: ``/jobs/17/duration``.
    LimitExceeded
        There are too many jobs, or some are sound but too large.
    """
    jobs, label = _parts(document)
    admitted: list[NewJob] = []
    problems: list[Problem] = []
    only_limits = True
    for index, one in enumerate(jobs):
        try:
            admitted.append(check(one, settings, now))
        except InvalidInput as error:
            only_limits &= isinstance(error, LimitExceeded)
            problems += [
                Problem(f"/jobs/{index}{problem.pointer}", problem.detail)
                for problem in error.problems
            ]
            if len(problems) >= _MOST_PROBLEMS:
                break
    if problems:
        raise (LimitExceeded if only_limits else InvalidInput)(problems)
    return admitted, label


def _submitted(job: object, settings: Settings, now: float) -> NewJob:
    return checked(job, settings, now)[0]


def _parts(document: object) -> tuple[Sequence[object], str]:
    """Take the document apart, or say what is wrong with it as a whole."""
    if not isinstance(document, dict):
        raise InvalidInput([Problem("", "A batch is a JSON object with a list of 'jobs'.")])
    problems = [
        Problem(f"/{escaped(name)}", "There is no such field; a batch has 'jobs' and 'label'.")
        for name in document
        if name not in BatchDocument.model_fields
    ]
    jobs: Any = document.get("jobs")
    label: Any = document.get("label", "")
    if not isinstance(jobs, list) or not jobs:
        problems.append(Problem("/jobs", "A batch needs a list of one job or more."))
    elif len(jobs) > MOST_JOBS:
        sentence = f"A batch takes at most {MOST_JOBS} jobs, not {len(jobs)}; send several batches."
        raise LimitExceeded([Problem("/jobs", sentence)])
    if not isinstance(label, str) or len(label) > LONGEST_LABEL:
        sentence = f"The label is a text of at most {LONGEST_LABEL} characters."
        problems.append(Problem("/label", sentence))
    if problems:
        raise InvalidInput(problems)
    return jobs, label
