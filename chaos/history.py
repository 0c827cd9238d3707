"""Record of what a service was asked and answered."""

from dataclasses import dataclass, field
from typing import Any


@dataclass
class Submission:
    """One job that was asked for, until it was accepted."""

    key: str
    template: int  # which of the jobs of the mix
    cancel: bool = False  # whether it is to be cancelled once it was accepted
    job: str | None = None
    cancelled: bool = False  # the service has answered that it will be
    state: str | None = None  # the last one that was read
    fraction: float = 0.0  # how far it was then

    @property
    def ended(self) -> bool:
        """Whether the service has said that the job ended."""
        return self.state in ("succeeded", "failed", "cancelled")


@dataclass
class History:
    """All submissions, how requests were answered, and what must not have been answered."""

    submissions: list[Submission] = field(default_factory=list)
    answers: dict[str, int] = field(default_factory=dict)
    violations: list[str] = field(default_factory=list)

    def count(self, answer: str) -> None:
        """Count an answer."""
        self.answers[answer] = self.answers.get(answer, 0) + 1

    def accepted(self, submission: Submission, job: str) -> None:
        """Note that a job was accepted; the same key must lead to the same job for ever."""
        if submission.job is not None and submission.job != job:
            self.violations.append(
                f"the key {submission.key} made job {submission.job} and then job {job}"
            )
        submission.job = job

    def seen(self, submission: Submission, document: dict[str, Any]) -> None:
        """Note a state that was read; a job that ended stays as it ended."""
        state = document["state"]
        if submission.ended and state != submission.state:
            self.violations.append(f"job {submission.job} was {submission.state}, then {state}")
        submission.state = state
        submission.fraction = document["progress"]["fraction"]

    @property
    def open(self) -> list[Submission]:
        """Submissions whose end was not read yet."""
        return [submission for submission in self.submissions if not submission.ended]
