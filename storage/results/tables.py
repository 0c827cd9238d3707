"""The tables of a store: history, Poincare sections, impacts and peaks.

A table is a Zarr group whose arrays all have one dimension of the same length. Its rows are
written in shards; a shard is one file an array, and is written once.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT, MEASURED
from jointplay.records.names import TIME
from jointplay.records.peak import PEAK
from jointplay.storage.results import metadata
from jointplay.storage.results.layout import SCHEMA_VERSION, Partition, ResultLayout
from jointplay.storage.results.metadata import DOUBLE, Document


class Column(NamedTuple):
    """One array of a table."""

    name: str
    dtype: np.dtype[Any]
    attributes: dict[str, Any]


@dataclass(frozen=True)
class Table:
    """Columns that grow together.

    `group` is the path of the Zarr group ("" for the root), `capacity` the number of rows of a
    complete run, or None where it is not known beforehand. `chunk_rows` are compressed
    together; `shard_rows`, a multiple of them, are in one file.
    """

    group: str
    dimension: str
    columns: tuple[Column, ...]
    capacity: int | None
    chunk_rows: int
    shard_rows: int
    attributes: dict[str, Any]

    def key(self, name: str) -> str:
        """Path of an array inside the store."""
        return f"{self.group}/{name}" if self.group else name

    def arrays(self, rows: int) -> dict[str, Document]:
        """Make the documents of the arrays by path."""
        shard = None if self.chunk_rows == self.shard_rows else [self.shard_rows]
        return {
            self.key(name): metadata.array(
                [rows], [self.chunk_rows], dtype, [self.dimension], attributes, shard=shard
            )
            for name, dtype, attributes in self.columns
        }


def tables(layout: ResultLayout) -> tuple[Table, Table, Table, Table]:
    """History, sections, impacts and peaks of a layout."""
    return _tables(_shape_of(layout))


class _Shape(NamedTuple):
    """Everything of a layout that its tables depend on, by which they are remembered."""

    channels: tuple[Channel, ...]
    samples: int
    sections: int
    joints: tuple[str, ...]
    partition: Partition
    steps: tuple[str, ...]
    intervals: bool


def _shape_of(layout: ResultLayout) -> _Shape:
    return _Shape(*(getattr(layout, name) for name in _Shape._fields))


# jobs of one kind come one after the other, and documents take longer than what is in them
@lru_cache(maxsize=16)
def _arrays(layout: _Shape, table: int, rows: int) -> Mapping[str, Document]:
    return _tables(layout)[table].arrays(rows)


@lru_cache(maxsize=4)
def _tables(layout: _Shape) -> tuple[Table, Table, Table, Table]:
    sampled = (
        *(Column(channel.name, DOUBLE, channel.attributes) for channel in layout.channels),
        # last, because readers take its shard for the sign that all others are there
        Column(TIME, DOUBLE, {"units": "s", "long_name": "time"}),
    )
    in_time = {"coordinates": TIME}  # makes xarray take `time` for a coordinate
    about = {
        "result_schema": SCHEMA_VERSION,
        "channels": [channel.name for channel in layout.channels],
        "joints": list(layout.joints),
        "complete": False,
    }
    if layout.steps:
        about["steps"] = list(layout.steps)
    if layout.intervals:
        about["intervals"] = True
    peaks = tuple(Column(name, DOUBLE, meaning) for name, meaning in PEAK.items())
    channels = {
        "channels": [channel.name for channel in layout.channels],
        "channel_units": [channel.unit for channel in layout.channels],
    }
    impacts = _impact_columns(layout.joints)

    def table(
        group: str,
        dimension: str,
        columns: tuple[Column, ...],
        capacity: int | None,
        attributes: dict[str, Any],
    ) -> Table:
        row_bytes = sum(column.dtype.itemsize for column in columns)
        cut = layout.partition.cut(capacity, row_bytes)
        return Table(group, dimension, columns, capacity, *cut, attributes)

    return (
        table("", "sample", sampled, layout.samples, in_time | about),
        table("poincare", "section", sampled, layout.sections, in_time),
        table("impacts", "impact", impacts, None, {}),
        table("peaks", "channel", peaks, len(layout.channels), channels),
    )


def documents(
    layout: ResultLayout,
    rows: Sequence[int],
    attributes: Mapping[str, Any],
    more: Mapping[str, Document] = MappingProxyType({}),
) -> dict[str, Document]:
    """Make every document of a store by its key.

    Parameters
    ----------
    layout
        Columns and root attributes.
    rows
        Rows that each of `tables(layout)` shows.
    attributes
        Root attributes that the layout does not know.
    more
        Nodes that no table has, by path.
    """
    nodes = dict(more)
    root: dict[str, Any] = {}
    shape = _shape_of(layout)
    for position, (table, count) in enumerate(zip(_tables(shape), rows, strict=True)):
        if table.group:
            nodes[table.group] = metadata.group(table.attributes, {})
        else:
            root = table.attributes
        nodes |= _arrays(shape, position, count)
    return metadata.documents({**layout.attributes, **root, **attributes}, nodes)


def _impact_columns(joints: tuple[str, ...]) -> tuple[Column, ...]:
    flags = {
        "long_name": "clearance joint",
        "flag_values": list(range(len(joints))),
        "flag_meanings": " ".join(name.replace(" ", "_") for name in joints),
    }
    measured = (
        Column(name, IMPACT[name], {"units": unit, "long_name": long_name})
        for name, (unit, long_name) in MEASURED.items()
    )
    return (Column("joint", IMPACT["joint"], flags), *measured)
