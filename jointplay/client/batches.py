"""A batch as the service describes it."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Self


@dataclass(frozen=True)
class Batch:
    """Jobs that were submitted together.

    ``counts`` has the number of jobs in each state, ``fraction`` says how much of the whole is
    done, 0 to 1.
    """

    id: str
    label: str | None
    created: datetime
    jobs: int
    counts: Mapping[str, int]
    fraction: float
    is_finished: bool

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        return cls(
            id=document["id"],
            label=document["label"],
            created=datetime.fromisoformat(document["created"]),
            jobs=document["jobs"],
            counts=document["states"],
            fraction=document["progress"]["fraction"],
            is_finished=document["finished"],
        )
