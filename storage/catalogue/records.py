"""The catalogue's records as its callers see them. All times are epoch seconds, UTC."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from hashlib import sha256
from typing import Any

from jointplay.records.job import JobError
from jointplay.storage.catalogue.numbers import number_of


class JobState(StrEnum):
    """State of a job. Legal steps are listed in `LEGAL_STEPS`."""

    queued = "queued"
    running = "running"
    cancelling = "cancelling"
    succeeded = "succeeded"
    failed = "failed"
    cancelled = "cancelled"

    @property
    def terminal(self) -> bool:
        """Whether the job will never change again."""
        return self in (JobState.succeeded, JobState.failed, JobState.cancelled)


# A cancelling job may still succeed: its last block may be done before it sees the request.
LEGAL_STEPS: Mapping[JobState, frozenset[JobState]] = {
    JobState.queued: frozenset({JobState.running, JobState.cancelled}),
    JobState.running: frozenset({JobState.cancelling, JobState.succeeded, JobState.failed}),
    JobState.cancelling: frozenset({JobState.cancelled, JobState.succeeded, JobState.failed}),
    JobState.succeeded: frozenset(),
    JobState.failed: frozenset(),
    JobState.cancelled: frozenset(),
}


TERMINAL = [state for state in JobState if state.terminal]
LIVE = [state for state in JobState if not state.terminal]

RECOVERED_QUEUE = "recovered"
INTERACTIVE_QUEUE = "interactive"
FRESH_QUEUE = "jobs"
QUEUES = (RECOVERED_QUEUE, INTERACTIVE_QUEUE, FRESH_QUEUE)
"""In the order in which one owner's blocks are claimed: what a worker had begun, jobs of one block
that came alone, then studies and batches; see `turns` for blocks of several owners."""


NOT_REPRODUCED = "a repetition by the same version of the solver gave other results"
"""Damage of a job whose results are what was stored, and not what the job gives."""


class BlockState(StrEnum):
    """State of a block; a lost or released one goes from running back to queued.

    The block that seals a study is waiting until all others are done.
    """

    waiting = "waiting"
    queued = "queued"
    running = "running"
    done = "done"
    failed = "failed"
    cancelled = "cancelled"


class Verdict(StrEnum):
    """Answer to a worker that reports."""

    go_on = "continue"
    cancel = "cancel"


@dataclass(frozen=True)
class Solver:
    """A version of the solver and a class of processors: what determines the bits."""

    version: str
    processor: str


@dataclass(frozen=True)
class WorkerDevice:
    """A graphics processor that computes points of studies for a worker."""

    device: str  # the maker's name, of at most 64 characters
    rate: float  # accepted steps a second in all lanes, as it was tried
    lanes: int  # points that it computes at a time


@dataclass(frozen=True)
class JobRequest:
    """Facts of a job that are known from the request for it on."""

    kind: str
    spec: dict[str, Any]
    digest: str
    solver_version: str
    result_schema: int = 1
    label: str | None = None
    batch: str | None = None
    scene: str | None = None  # its name, by which jobs are found
    expires: float | None = None
    owner: str = ""  # by whose keys it is seen; empty: nobody's


@dataclass(frozen=True)
class NewJob(JobRequest):
    """A checked job about to be submitted; `blocks` are (first, count) of its units of work.

    With `seal` there is one more, with a count of 0, that is queued when all others are done: it
    finishes the store that they filled, and the job succeeds with it. `retry_of` is the id of a job
    that failed or was cancelled and is computed again by this one.
    """

    blocks: tuple[tuple[int, int], ...] = ((0, 1),)
    seal: bool = False
    retry_of: str | None = None

    @property
    def number(self) -> int:
        """Sixty-four bits of what is computed, by which units that look for it take turns."""
        return number_of("computes", f"{self.digest} {self.owner}")


@dataclass(frozen=True)
class SubmissionKey:
    """An idempotency key: the same key and fingerprint return the job of the first request."""

    key: str
    fingerprint: str
    seconds: float = 86_400.0  # how long the key is remembered
    owner: str = ""  # two owners may use one key

    @property
    def stored(self) -> str:
        """The key as it is stored: an owner's with a blank, which no client's own has."""
        if not self.owner:
            return self.key
        return f" {sha256(f'{self.owner} {self.key}'.encode()).hexdigest()}"

    @property
    def number(self) -> int:
        """Sixty-four bits of the key, by which units that look for it take turns."""
        return number_of("key", self.stored)


@dataclass(frozen=True, kw_only=True)
class Job(JobRequest):
    """One job. `attempt` counts from 1 and names its results folder; 0: never started."""

    id: str
    created: float
    state: JobState = JobState.queued
    progress_time: float = 0.0  # simulated seconds
    progress_fraction: float = 0.0  # 0..1
    attempt: int = 0
    error: JobError | None = None
    started: float | None = None
    finished: float | None = None
    activity: str | None = None  # a word for what takes long before anything advances: "compiling"
    steps: int | None = None  # accepted steps of the solver, as far as they are known
    removed: float | None = None  # when its results were removed
    damaged: str | None = None  # which file of its results is not what was stored
    processor: str | None = None  # class of the processors that compute it, from its first claim on
    stored: int | None = None  # bytes of its results, if it has ended and is some owner's
    deleted: float | None = None  # when it was, by the clock that may be set later
    kept_for: float | None = None  # s from the submission that asked for most; none: see `lifetime`
    further_labels: tuple[str, ...] | None = None  # that it was asked for with later; in no row

    @property
    def lifetime(self) -> float | None:
        """For how long a submission asked for it to be kept, at most, s; None: for ever.

        It may expire later than that: it ended late, or was found by a later submission.
        """
        if self.expires is None:
            return None
        return self.expires - self.created if self.kept_for is None else self.kept_for

    def expired(self, now: float) -> bool:
        """Whether it and its results can be read no more; what is still live never expires.

        What was deleted or removed stays so, whatever the clock says.
        """
        due = self.expires is not None and self.expires <= now
        gone = self.removed is not None or self.deleted is not None
        return self.state.terminal and (due or gone)


@dataclass(frozen=True)
class Submitted:
    """Answer to a submission.

    `created` is false if an idempotency key found an earlier job, `cached` is true if the job is
    one that another request had submitted before, because both ask for the same.
    """

    job: Job
    created: bool
    cached: bool = False


@dataclass(frozen=True)
class JobPage:
    """One page of a list of jobs; `next` is the `after` of the following page, if any."""

    jobs: tuple[Job, ...]
    next: str | None


@dataclass(frozen=True)
class Batch:
    """Jobs that were submitted together, and how far the whole of them is."""

    id: str
    label: str | None
    created: float
    count: int  # jobs
    states: Mapping[JobState, int]  # how many jobs are in each state; every state is there
    fraction: float  # 0..1, every job weighing the same; a job that ended lacks nothing
    owner: str = ""

    @property
    def finished(self) -> bool:
        """Whether no job of it will ever change again."""
        return sum(n for state, n in self.states.items() if state.terminal) == self.count


@dataclass(frozen=True)
class SubmittedBatch:
    """Answer to a batch: ids of its jobs, in the order in which they were submitted."""

    batch: Batch
    jobs: tuple[str, ...]
    created: bool


@dataclass(frozen=True)
class Block:
    """Unit of claims, leases, fencing and resuming: values `first` .. `first + count - 1`."""

    id: str
    job: str
    index: int
    first: int
    count: int
    state: BlockState
    attempt: int = 0
    losses: int = 0  # workers lost in a row without progress, which is what max_attempts limits
    lease_until: float | None = None
    worker: str | None = None
    watermark: int = 0  # samples (or values) that are durable in the results store
    checkpoint: str | None = None  # path of the checkpoint below the job's results folder
    progress_time: float = 0.0
    progress_fraction: float = 0.0
    progress_steps: int | None = None


@dataclass(frozen=True)
class BlockEnd:
    """End of a block, and how far it came, where that is known; one that is done came all the way.

    Raises
    ------
    ValueError
        A failed block, and no other, has an error.
    """

    outcome: BlockState  # done, failed or cancelled
    error: JobError | None = None
    time: float | None = None  # simulated seconds
    fraction: float | None = None  # 0..1
    steps: int | None = None
    repeatable: bool = False
    """Whether the block would quickly be found to have ended: no disk is waited for."""

    def __post_init__(self) -> None:
        if (self.outcome is BlockState.failed) != (self.error is not None):
            raise ValueError("a failed block, and no other, has an error")
        if self.outcome is BlockState.done:
            object.__setattr__(self, "fraction", 1.0)


@dataclass(frozen=True)
class Attempt:
    """One try at a block; `outcome` is none while it runs, later a word."""

    block: str
    number: int
    worker: str
    started: float
    ended: float | None
    outcome: str | None


@dataclass(frozen=True)
class Claim:
    """A block this worker holds now, with its job."""

    block: Block
    job: Job


@dataclass(frozen=True)
class Event:
    """One thing that happened to a job; `seq` counts from 1 without gaps."""

    job: str
    seq: int
    time: float
    type: str
    data: dict[str, Any]


@dataclass(frozen=True)
class JobStatus:
    """Changing facts of a job in progress; `last_event` is the number of its newest event."""

    job: str
    state: JobState
    activity: str | None
    attempt: int
    time: float  # simulated seconds
    fraction: float  # 0..1
    steps: int | None
    last_event: int


@dataclass(frozen=True)
class JobFilter:
    """Which jobs to list; what is none does not matter. Times are of the submission."""

    state: JobState | None = None
    kind: str | None = None
    label: str | None = None
    scene: str | None = None
    batch: str | None = None
    since: float | None = None  # from this time on
    before: float | None = None
    owner: str | None = None
