"""Branches of periodic orbits as columns, from wherever a continuation's results are read."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.point import Failure, PointStatus
from jointplay.records.run import Floats
from jointplay.records.strict_json import finite
from jointplay.records.study import StudySource

VALUE, LABEL, BOUND, LENGTH, UNSTABLE = "value", "label", "bound", "length", "unstable"
"""Columns that every branch has."""
SECOND, SECOND_BOUND = "second", "second_bound"
"""Columns where special orbits are followed over a second parameter."""
CURVES = ("LP", "PD", "GR", "NS")
"""Labels of special orbits that are followed so."""


@dataclass(frozen=True)
class Special:
    """A special orbit of a branch."""

    row: int
    """Index of the orbit in the columns."""
    label: str
    """As AUTO and COCO print it."""
    value: float
    bound: float
    """Its parameter, and the largest error of that."""
    second: float | None
    second_bound: float | None
    """The same of the second parameter, where one varies."""
    note: str
    """The event there; at the end of a branch its reason, and what may be tried."""


@dataclass(frozen=True)
class Branch:
    """One branch: an orbit each row, in the order of being found."""

    index: int
    status: PointStatus
    failure: Failure | None
    columns: Mapping[Channel, Floats]
    special: tuple[Special, ...]

    @property
    def of(self) -> str:
        """Label of the special orbits that a curve over two parameters is of; else empty."""
        first = self.special[0].label if self.special and not self.special[0].row else ""
        return first if first in CURVES else ""

    def column(self, name: str) -> Floats:
        """Return a column by its name."""
        return next(values for channel, values in self.columns.items() if channel.name == name)


def branches(source: StudySource) -> Iterator[Branch]:
    """Yield the branches of a continuation as far as they are known."""
    labels: Mapping[str, str] = source.attributes["labels"]
    names = list(labels)
    for index in range(source.points):
        count = int(source.counts[index])
        columns = {
            one: source.sections(one.name, index, index + 1)[0][:count]
            for one in source.observables
        }
        by_name = {one.name: values for one, values in columns.items()}
        notes: dict[int, Any] = {}
        if document := source.documents.get(index):
            notes = {one["row"]: one["note"] for one in document["special"]}
        special = []
        for row in np.flatnonzero(by_name[LABEL]).tolist():
            label = names[int(by_name[LABEL][row])]
            at, bound = float(by_name[VALUE][row]), float(by_name[BOUND][row])
            second, error = (
                float(by_name[name][row]) if name in by_name else None
                for name in (SECOND, SECOND_BOUND)
            )
            note = notes.get(row, labels[label])
            special.append(Special(row, label, at, bound, second, error, note))
        status = PointStatus(int(source.status[index]))
        yield Branch(index, status, source.failures.get(index), columns, tuple(special))


def branch_document(source: StudySource, names: Collection[str] | None = None) -> dict[str, Any]:
    """Return the branches of a continuation as JSON has them; `names` of columns, all if None."""
    parameter, *second = source.parameters
    return {
        "complete": source.complete,
        "parameter": parameter.name,
        "unit": parameter.unit,
        "second": second[0].name if second else None,
        "second_unit": second[0].unit if second else None,
        "labels": list(source.attributes["labels"]),
        "branches": [_document(one, names) for one in branches(source)],
    }


def _document(branch: Branch, names: Collection[str] | None) -> dict[str, Any]:
    failure = branch.failure
    return {
        "index": branch.index,
        "of": branch.of,
        "status": branch.status.name,
        "failure": failure and {"point": branch.index, **failure._asdict()},
        "columns": {
            one.name: {
                "unit": one.unit,
                "long_name": one.long_name,
                "values": finite(values.tolist()),
            }
            for one, values in branch.columns.items()
            if names is None or one.name in names
        },
        "special": [asdict(one) for one in branch.special],
    }
