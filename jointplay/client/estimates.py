"""What a job will cost, as the service says."""

from dataclasses import dataclass, fields
from typing import Any, Self


@dataclass(frozen=True)
class Estimate:
    """What a job will cost on the machine of the service.

    ``seconds`` of one core, accepted ``steps`` of the solver, ``bytes`` on the disk; ``blocks``
    can be computed at the same time.  ``exact``: the whole job was computed for it.  ``failure``
    says why it will end early, ``cached`` that an identical job is there already.
    """

    seconds: float
    steps: int
    bytes: int
    points: int
    blocks: int
    exact: bool
    failure: str | None
    cached: bool

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        return cls(**{field.name: document[field.name] for field in fields(cls)})
