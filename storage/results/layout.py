"""Layout of a results store: named columns with units, how many rows, and how they are cut."""

import json
from collections.abc import Container, Iterable
from dataclasses import astuple, dataclass, field
from hashlib import sha256
from typing import Any, Final

from jointplay.records.channel import Channel
from jointplay.records.names import STORED, is_storable
from jointplay.storage.errors import InvalidLayout

MANIFEST: Final = "MANIFEST.json"
SCHEMA_VERSION: Final = 1


@dataclass(frozen=True)
class Partition:
    """Bounds for cutting a table; the defaults suit histories of any length.

    Parameters
    ----------
    chunk_rows
        Rows that are compressed together. 16 384 doubles are 128 KiB, which the compressor
        takes as one block: with several blocks its output would depend on its threads.
    shard_chunks
        Most chunks in one file.
    buffer_bytes
        Most bytes of one table that wait in memory for their shard to fill.
    pyramid_above
        A history of more samples gets a pyramid of extremes.
    bucket
        Samples of the finest extremes.
    level_rows
        Extremes of a level in one file, a multiple of 16.
    """

    chunk_rows: int = 16_384
    shard_chunks: int = 32
    buffer_bytes: int = 32 * 2**20
    pyramid_above: int = 16_384
    bucket: int = 64
    level_rows: int = 1024

    def cut(self, capacity: int | None, row_bytes: int) -> tuple[int, int]:
        """Give rows of a chunk and of a shard; a shard is a whole number of chunks.

        Parameters
        ----------
        capacity
            Rows of the complete table; None if that is not known beforehand.
        row_bytes
            Bytes of one row over all columns.
        """
        if capacity is not None and capacity <= self.chunk_rows:
            return max(capacity, 1), max(capacity, 1)
        fitting = self.buffer_bytes // row_bytes
        if fitting < self.chunk_rows:
            if fitting > self.bucket:
                fitting -= fitting % self.bucket
            return max(fitting, 1), max(fitting, 1)
        chunks = min(fitting // self.chunk_rows, self.shard_chunks)
        if capacity is not None:
            chunks = min(chunks, -(-capacity // self.chunk_rows))
        return self.chunk_rows, chunks * self.chunk_rows


@dataclass(frozen=True)
class ResultLayout:
    """Everything that fixes the shape of a store before the first row is known.

    Parameters
    ----------
    channels
        Columns of the history and of the Poincare sections, in this order.
    samples
        Rows of a history that runs to its end.
    sections
        Poincare sections of a run that comes to its end; 0 where there are none.
    joints
        Names of the contact pairs that impacts refer to by index.
    attributes
        JSON document for the root group: the filled-in job, versions, the digest.
    partition
        How rows are cut into files.
    steps
        Columns of the accepted steps; none where they are not kept.
    steps_period
        What their whole periods are of, s.
    intervals
        Whether extremes between samples are kept where steps are not.

    Raises
    ------
    InvalidLayout
        A name that a store cannot hold or that occurs twice, a negative count, or attributes
        that JSON cannot carry.
    """

    channels: tuple[Channel, ...]
    samples: int
    sections: int
    joints: tuple[str, ...]
    attributes: dict[str, Any] = field(default_factory=dict)
    partition: Partition = field(default_factory=Partition)
    steps: tuple[str, ...] = ()
    steps_period: float = 0.0
    intervals: bool = False

    def __post_init__(self) -> None:
        check_names(self.channels, "channel", STORED)
        if self.samples < 0 or self.sections < 0:
            raise InvalidLayout("samples and sections are counts and cannot be negative")
        check_attributes(self.attributes)

    @property
    def digest(self) -> str:
        """SHA-256 over the arrays (not the attributes): two runs with it can share shards."""
        shape = [
            SCHEMA_VERSION,
            self.channels,
            self.samples,
            self.sections,
            list(self.joints),
            list(self.steps),
            self.intervals,
            astuple(self.partition),
        ]
        return sha256(json.dumps(shape).encode()).hexdigest()


def check_names(specs: Iterable[Channel], what: str, reserved: Container[str] = ()) -> None:
    """Raise `InvalidLayout` if arrays cannot have these names in one group of a store."""
    seen: set[str] = set()
    for name in (spec.name for spec in specs):
        if not is_storable(name):
            raise InvalidLayout(
                f"{name!r} cannot name an array: use 1 to 64 letters, digits, '_', "
                "'.' and '-', not starting with '.' and not ending in .json or .partial"
            )
        if name in reserved:
            raise InvalidLayout(f"{name!r} cannot name a {what}: the store uses that name itself")
        if name in seen:
            raise InvalidLayout(f"{what} {name!r} occurs twice; names are unique")
        seen.add(name)


def check_attributes(attributes: dict[str, Any]) -> None:
    """Raise `InvalidLayout` if a store's document cannot hold these attributes."""
    try:
        json.dumps(attributes, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InvalidLayout(f"attributes must be finite JSON values: {error}") from error
