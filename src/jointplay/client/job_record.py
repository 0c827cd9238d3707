"""A job as the service describes it: its record as it was last seen, and its estimated cost."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from datetime import datetime
from typing import Any, Self

from jointplay.client.errors import ClientError
from jointplay.records.job import JobError, Progress

TERMINAL_STATES = frozenset({"succeeded", "failed", "cancelled"})


@dataclass(frozen=True)
class Estimate:
    """Expected cost of a job on the machine of the service.

    ``seconds`` of one core, beside those that the ``compilation`` of its equations took (0: they
    were compiled); ``device_seconds`` that the graphics processors of all workers take together
    instead (None: there are none, or none computes it); accepted ``steps`` of the solver, ``bytes``
    on the disk; ``blocks`` can be computed at the same time.  ``exact``: the whole job was computed
    for it.  ``at_most``: a map that is refined computes few of its points, and costs less.
    ``failure`` says why it will end early, ``cached`` that an identical job is there already.
    """

    seconds: float
    compilation: float
    device_seconds: float | None
    steps: int
    bytes: int
    points: int
    blocks: int
    exact: bool
    at_most: bool
    failure: str | None
    cached: bool

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        return cls(**{field.name: document[field.name] for field in fields(cls)})


@dataclass
class JobRecord:
    """One job; ``job`` is its document with every default filled in.

    ``label`` is the first of the ``labels`` that it was asked for with: other requests for the same
    computation are answered with it, too.
    ``activity`` says what it is busy with before it advances, such as compiling.  ``cached``: the
    answer to a submission was a job that was there already.  ``damaged`` says which file of its
    results is not what was stored: submit ``job`` again.
    """

    id: str
    kind: str
    label: str | None
    batch: str | None
    state: str
    activity: str | None
    progress: Progress
    attempt: int
    created: datetime
    started: datetime | None
    finished: datetime | None
    expires: datetime | None
    error: JobError | None
    links: dict[str, str]
    job: dict[str, Any]
    solver_version: str | None
    cached: bool = field(default=False, compare=False)
    damaged: str | None = None
    labels: list[str] = field(default_factory=list)

    @property
    def is_finished(self) -> bool:
        """True if the state will not change any more."""
        return self.state in TERMINAL_STATES

    @property
    def is_study(self) -> bool:
        """True if it has points, and not one history."""
        return "history" not in self.links

    @property
    def scene_name(self) -> str:
        """Name of the preset, or of the scene that was given whole."""
        scene = self.job["scene"]
        return str(scene.get("preset") or scene.get("name"))

    @property
    def seconds(self) -> float | None:
        """Time from the start of the computation to its end, s."""
        if self.started is None or self.finished is None:
            return None
        return (self.finished - self.started).total_seconds()

    @property
    def done_so_far(self) -> str:
        """Progress in words: simulated time, or of a study the part of all its points."""
        done = f"{self.progress.fraction:.0%}"
        return done if self.is_study else f"t = {self.progress.time:.4g} s ({done})"

    def to_document(self) -> dict[str, Any]:
        """Return the job as JSON takes it."""
        found = {
            name: value.isoformat() if isinstance(value, datetime) else value
            for name, value in asdict(self).items()
        }
        return found | {"error": self.error and self.error.document()}

    def renew(self, document: Mapping[str, Any]) -> None:
        """Take over what the service says now."""
        vars(self).update(read_job(document))

    def advance(self, snapshot: Mapping[str, Any]) -> bool:
        """Take over what an event says, and tell whether that is anything new."""
        try:
            news = {name: snapshot[name] for name in ("state", "activity", "attempt")}
            news["progress"] = Progress(**snapshot["progress"])
        except (KeyError, TypeError) as error:
            raise ClientError(f"The service sent an event that is none: {snapshot}") from error
        changed = any(getattr(self, name) != value for name, value in news.items())
        vars(self).update(news)
        return changed


def read_job(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a `JobRecord` from the service's JSON."""
    found = {one.name: document[one.name] for one in fields(JobRecord) if one.name in document}
    for name in ("created", "started", "finished", "expires"):
        found[name] = found[name] and datetime.fromisoformat(found[name])
    error = found["error"] and JobError.of(found["error"])
    return found | {"progress": Progress(**found["progress"]), "error": error}
