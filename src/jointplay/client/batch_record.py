"""A batch as the service describes it: its record as it was last seen."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from datetime import datetime
from typing import Any

from jointplay.client.notebook import html_table


@dataclass
class BatchRecord:
    """Jobs that were submitted together, as they were last seen.

    ``counts`` has the number of jobs in each state, ``fraction`` says how much of the whole is
    done, 0 to 1.
    """

    id: str
    label: str | None
    created: datetime
    size: int
    counts: Mapping[str, int]
    fraction: float
    is_finished: bool

    def _repr_html_(self) -> str:
        return html_table("batch", {"id": self.id, "label": self.label, "jobs": self.states})

    @property
    def states(self) -> str:
        """Numbers of jobs in each state, in words."""
        counts = [f"{count} {state}" for state, count in self.counts.items() if count]
        return f"{self.size} jobs: {', '.join(counts)}"

    def to_document(self) -> dict[str, Any]:
        """Return the batch as JSON takes it."""
        found = {one.name: getattr(self, one.name) for one in fields(BatchRecord)}
        return found | {"created": self.created.isoformat()}

    def renew(self, document: Mapping[str, Any]) -> None:
        """Take over what the service says now."""
        vars(self).update(read_batch(document))


def read_batch(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a `BatchRecord` from the service's JSON."""
    return {
        "id": document["id"],
        "label": document["label"],
        "created": datetime.fromisoformat(document["created"]),
        "size": document["jobs"],
        "counts": document["states"],
        "fraction": document["progress"]["fraction"],
        "is_finished": document["finished"],
    }
