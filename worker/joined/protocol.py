"""Documents between a service and the workers that joined it."""

from typing import Annotated, Final, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from jointplay.records.job import JobError
from jointplay.storage.catalogue.counters import OF_WORKERS
from jointplay.storage.catalogue.records import BlockState, Claim, JobState, Solver, Verdict
from jointplay.storage.settings import LONGEST_PERIOD, Settings

LONGEST_WAIT: Final = 20.0
"""Seconds after which a service says that there is no block."""
_RARER: Final = 2.0
"""Workers that joined make restart points, each of which is several requests, so much more rarely
than a service's own."""
_Word = Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9._+-]+$")]
_Count = Annotated[int, Field(ge=0, le=2**53)]
_Fraction = Annotated[float, Field(ge=0.0, le=1.0)]
_Time = Annotated[float, Field(ge=0.0, le=1e12)]


def _an_end(state: BlockState) -> BlockState:
    if state not in (BlockState.done, BlockState.failed, BlockState.cancelled):
        raise ValueError("a block ends as done, failed or cancelled")
    return state


def _of_a_worker(spent: dict[str, float]) -> dict[str, float]:
    if not spent.keys() <= {*OF_WORKERS}:
        raise ValueError(f"a worker counts {', '.join(OF_WORKERS)}")
    return spent


def _of_text(error: JobError) -> JobError:
    if "\0" in error.code + error.detail:
        raise ValueError("PostgreSQL stores no NUL")
    return error


class Document(BaseModel):
    """A document with these fields and no others, and finite numbers."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)


class Device(Document):
    """A device of a worker; see `storage.catalogue.records.WorkerDevice`."""

    device: Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[ -~]+$")]
    rate: Annotated[float, Field(ge=1.0, le=1e15)]
    lanes: Annotated[int, Field(ge=1, le=10**8)]


class ClaimRequest(Document):
    """A worker that has nothing to do."""

    program: _Word  # version of the whole program, whose major one must be the service's
    worker: Annotated[str, Field(min_length=1, max_length=160, pattern=r"^[A-Za-z0-9._:-]+$")]
    version: _Word
    processor: _Word
    wait: Annotated[float, Field(ge=0.0, le=LONGEST_WAIT)] = LONGEST_WAIT
    spent: Annotated[dict[str, _Time], AfterValidator(_of_a_worker)] = {}
    """Seconds, and results, since it asked last; by the names of `storage.catalogue.counters`."""
    device: Device | None = None

    @property
    def solver(self) -> Solver:
        """The worker's."""
        return Solver(self.version, self.processor)


class ClaimBeside(Document):
    """A worker that computes many blocks of a study at once, and holds one of them."""

    version: _Word
    processor: _Word
    most: Annotated[int, Field(ge=1, le=64)]

    @property
    def solver(self) -> Solver:
        """The worker's."""
        return Solver(self.version, self.processor)


class ClaimedBeside(Document):
    """Further blocks of the study, which the worker holds now."""

    claims: tuple[Claim, ...]


class Customs(Document):
    """Settings of the service that its workers share; all are seconds."""

    lease: float
    heartbeat: float
    progress_period: float
    longest: float
    longest_compilation: float
    stall: float

    @classmethod
    def of(cls, settings: Settings) -> Self:
        """Choose them."""
        own = {name: getattr(settings, name) for name in cls.model_fields}
        rarely = min(_RARER * settings.progress_period, LONGEST_PERIOD)
        return cls(**own | {"progress_period": rarely})


class Claimed(Document):
    """A block that the worker holds now."""

    claim: Claim
    customs: Customs


class File(Document):
    """A file that the attempt builds on."""

    name: str
    size: int


class Files(Document):
    """All of them."""

    files: tuple[File, ...]


class Drop(Document):
    """A file that is put into the bucket itself, or was."""

    name: Annotated[str, Field(min_length=1, max_length=300)]
    size: Annotated[int, Field(ge=1, le=5 * 10**9)]  # the most of one request
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
    md5: Annotated[str, Field(pattern=r"^[0-9a-f]{32}$")]  # what most stores say of an object


class DropAt(Document):
    """Address at which a file may be put for a quarter of an hour."""

    address: str


class Progress(Document):
    """Progress of a block; see `Catalogue.record_progress`."""

    time: _Time
    fraction: _Fraction
    steps: _Count | None = None


class Checkpoint(Document):
    """A restart point whose files were sent, and how far the block is by now."""

    watermark: _Count
    checkpoint: Annotated[str, Field(pattern=r"^(block0|\d{5})-a\d{1,9}$")]
    progress: Progress | None = None


class Busy(Document):
    """Activity before a block advances: a word of a job's history, which has others."""

    activity: Literal["compiling"]


class Activity(Document):
    """A few words for what a block waits for."""

    activity: Annotated[str, Field(min_length=1, max_length=32, pattern=r"^[ -~]+$")]


class Finish(Document):
    """The end of a block."""

    outcome: Annotated[BlockState, AfterValidator(_an_end)]
    error: Annotated[JobError, AfterValidator(_of_text)] | None = None
    time: _Time | None = None
    fraction: _Fraction | None = None
    steps: _Count | None = None
    repeatable: bool = False


class Answered(Document):
    """Whether to go on."""

    verdict: Verdict


class Finished(Document):
    """State of the job after the end of a block."""

    state: JobState
