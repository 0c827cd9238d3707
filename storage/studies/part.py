"""Part of one block beside its finished chunks: one file, replaced as the block advances.

It holds the status and the numbers of every point of the block, the sections whose chunk is not
full yet, and the restart point of the computation, all of one moment. When a block is done its
last part remains until the study is sealed.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, Final, Self

from numpy.typing import NDArray

from jointplay.records import checkpoint
from jointplay.records.checkpoint import packed
from jointplay.records.point import Failure, has_ended
from jointplay.records.run import Floats
from jointplay.storage.errors import CheckpointMismatch, CorruptStore
from jointplay.storage.packed.running import PARTS, Running
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.points import Points, ordered, unknown

_KIND: Final = "part of a study"


@dataclass
class Part(Points):
    """A block's points as far as they are known.

    `open` holds by (row, column) of the grid of chunks the sections of chunks that are not in the
    store yet: (observables + 1, points, sections), times last.
    """

    index: int = 0
    open: dict[tuple[int, int], Floats] = field(default_factory=dict)
    carried: bytes = b""
    """Whatever continues the computation from this moment; empty when the block is done."""

    @classmethod
    def empty(cls, layout: StudyLayout, index: int) -> Self:
        """Begin a block of which nothing is known."""
        return cls(*unknown(layout.blocks[index][1], len(layout.channels)), index=index)

    @property
    def ended(self) -> int:
        """Points that have ended."""
        return int(has_ended(self.status).sum())

    @property
    def nbytes(self) -> int:
        """Bytes of the arrays, and roughly of the sentences."""
        arrays: list[NDArray[Any]] = [self.status, self.counts, self.peaks]
        arrays += [*self.numbers.values(), *self.open.values()]
        said = sum(map(len, self.reasons.values())) + 200 * (len(self.failures) + len(self.reasons))
        return sum(array.nbytes for array in arrays) + said + len(self.carried)

    def encode(self, layout: StudyLayout) -> bytes:
        """Give the bytes of the file: the same for the same part."""
        arrays: dict[str, NDArray[Any]] = {
            "status": self.status,
            "counts": self.counts,
            "peaks": self.peaks,
        }
        arrays |= {name: self.numbers[name] for name in ordered(self.numbers)}
        arrays |= {
            f"open/{row}/{column}": self.open[row, column] for row, column in sorted(self.open)
        }
        facts = {
            "block": self.index,
            "failures": {str(point): failure for point, failure in sorted(self.failures.items())},
            "reasons": {str(point): reason for point, reason in sorted(self.reasons.items())},
            "documents": {str(point): one for point, one in sorted(self.documents.items())},
        }
        arrays["carried"] = packed(self.carried)
        return checkpoint.encode(_KIND, layout.digest, facts, arrays)

    def written(self, layout: StudyLayout) -> Iterator[tuple[int, int]]:
        """List the chunks that must be in the store by now, by (row, column) of their grid."""
        points, sections = layout.chunk
        first, count = layout.blocks[self.index]
        for row in range(first // points, -(-(first + count) // points) if layout.record else 0):
            begin, end = row * points - first, min((row + 1) * points, layout.points) - first
            if begin < 0 or end > count:
                continue  # shared with other blocks: written when the study is sealed
            reached = int(self.counts[begin:end].max())
            for column in range(-(-reached // sections)):
                if (row, column) not in self.open:
                    yield row, column

    @classmethod
    def read(cls, files: Running, name: str, digest: str) -> Self:
        """Read a part, by its name in the folder `PARTS`, of the store with this layout's digest.

        Raises
        ------
        FileNotFoundError
            It is not there (any more).
        CorruptStore
            It is damaged, or that of another block.
        CheckpointMismatch
            It belongs to another study.
        """
        content, shown = files.part(name), f"{PARTS}/{name}"
        try:
            facts, arrays = checkpoint.decode(content, _KIND, digest)
        except checkpoint.ForeignCheckpoint as error:
            raise CheckpointMismatch(f"{shown} belongs to another study: {error}") from error
        except checkpoint.UnusableCheckpoint as error:
            raise CorruptStore(f"{shown} cannot be read: {error}") from error
        if facts["block"] != int(name.partition("-")[0]):
            raise CorruptStore(f"{shown} is the part of block {facts['block']}")
        part = cls(arrays["status"], arrays["counts"], arrays["peaks"], index=facts["block"])
        for key, array in arrays.items():
            group, _, member = key.partition("/")
            if group == "open":
                row, _, column = member.partition("/")
                part.open[int(row), int(column)] = array
            elif member:
                part.numbers[key] = array
        failures = facts["failures"].items()
        part.failures = {int(point): Failure(*failure) for point, failure in failures}
        part.reasons = {int(point): reason for point, reason in facts["reasons"].items()}
        part.documents = {int(point): one for point, one in facts["documents"].items()}
        part.carried = arrays["carried"].tobytes()
        return part


def final_name(index: int) -> str:
    """Name the last part of a block, in the folder `PARTS`."""
    return f"{index:05d}"


def is_last(name: str) -> bool:
    """Tell whether a part is the last one of its block, which never changes."""
    return name.isdigit()


def name_of(index: int, attempt: int) -> str:
    """Name what one attempt at a block has reached, in the folder `PARTS`."""
    return f"{index:05d}-a{attempt}"


def attempt_of(name: str) -> int | None:
    """Return the number of the attempt that wrote a part of that name; None of a block's last."""
    number = name.partition("-a")[2]
    return int(number) if number else None


def newest(names: Iterable[str]) -> dict[int, str]:
    """Find each block's last part, or else that of its latest attempt, by the block's index."""
    found: dict[int, tuple[float, str]] = {}
    for name in names:
        index, _, attempt = name.partition("-a")
        if not index.isdigit() or not (attempt.isdigit() or not attempt):
            continue  # being written
        rank = float(attempt or "inf")
        if int(index) not in found or rank > found[int(index)][0]:
            found[int(index)] = (rank, name)
    return {index: name for index, (_, name) in found.items()}
