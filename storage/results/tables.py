"""The tables of a store: history, Poincare sections, impacts and peaks.

A table is a Zarr group whose arrays all have one dimension of the same length. Its rows are
written in shards; a shard is one file an array, and is written once.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

import numpy as np

from storage.results.layout import IMPACT, SCHEMA_VERSION, TIME, Peak, ResultLayout

CHUNK_ROWS: Final = 16_384
"""Rows that are compressed together: 128 KiB, one block for the compressor, so that its output
does not depend on how many threads it has."""
_MOST_SHARD_ROWS: Final = 32 * CHUNK_ROWS
_FEWEST_SHARD_ROWS: Final = 1024
_BUFFER_BYTES: Final = 32 * 2**20
"""Bound on the rows of one table that wait for their shard to fill."""

_DOUBLE: Final = np.dtype("<f8")
_IMPACT_MEANING: Final = {
    "onset": ("s", "time of impact onset"),
    "release": ("s", "time of release"),
    "approach_rate": ("m/s", "approach rate at onset"),
    "peak_force": ("N", "largest normal contact force"),
    "impulse": ("N s", "impulse of the normal contact force"),
}
_PEAK_MEANING: Final = {
    "minimum": {"long_name": "smallest value, in the unit of its channel"},
    "minimum_time": {"units": "s", "long_name": "time of the smallest value"},
    "maximum": {"long_name": "largest value, in the unit of its channel"},
    "maximum_time": {"units": "s", "long_name": "time of the largest value"},
}


@dataclass(frozen=True)
class Column:
    """One array of a table."""

    name: str
    dtype: np.dtype[Any]
    attributes: dict[str, Any]

    @property
    def fill(self) -> float | int:
        """Value of rows that were not written."""
        return -1 if self.dtype.kind == "i" else float("nan")


@dataclass(frozen=True)
class Table:
    """Columns that grow together.

    `group` is the path of the Zarr group ("" for the root), `capacity` the number of rows of a
    complete run, or None where it is not known beforehand.
    """

    group: str
    dimension: str
    columns: tuple[Column, ...]
    capacity: int | None
    attributes: dict[str, Any] = field(default_factory=dict)

    def key(self, name: str) -> str:
        """Path of an array inside the store."""
        return f"{self.group}/{name}" if self.group else name

    @cached_property
    def shard_rows(self) -> int:
        """Rows in one file: the most that keeps the buffer of the whole table within bounds."""
        if self.capacity is not None and self.capacity <= CHUNK_ROWS:
            return max(self.capacity, 1)
        row_bytes = sum(column.dtype.itemsize for column in self.columns)
        fitting = 1 << (_BUFFER_BYTES // row_bytes).bit_length() - 1
        return min(max(fitting, _FEWEST_SHARD_ROWS), _MOST_SHARD_ROWS)

    @cached_property
    def chunk_rows(self) -> int:
        """Rows in one compressed chunk; divides `shard_rows`."""
        return min(self.shard_rows, CHUNK_ROWS)


def tables(layout: ResultLayout) -> tuple[Table, Table, Table, Table]:
    """History, sections, impacts and peaks of a layout."""
    sampled = (
        *(
            Column(
                channel.name, _DOUBLE, {"units": channel.unit, "long_name": channel.long_name}
            )
            for channel in layout.channels
        ),
        # last, because readers take its shard for the sign that all others are there
        Column(TIME, _DOUBLE, {"units": "s", "long_name": "time"}),
    )
    in_time = {"coordinates": TIME}  # makes xarray take `time` for a coordinate
    about = {
        "result_schema": SCHEMA_VERSION,
        "channels": [channel.name for channel in layout.channels],
        "joints": list(layout.joints),
        "complete": False,
    }
    peaks = tuple(Column(name, _DOUBLE, _PEAK_MEANING[name]) for name in Peak._fields)
    channels = {
        "channels": [channel.name for channel in layout.channels],
        "channel_units": [channel.unit for channel in layout.channels],
    }
    return (
        Table("", "sample", sampled, layout.samples, in_time | about),
        Table("poincare", "section", sampled, layout.sections, in_time),
        Table("impacts", "impact", _impact_columns(layout.joints), None),
        Table("peaks", "channel", peaks, len(layout.channels), channels),
    )


def _impact_columns(joints: tuple[str, ...]) -> tuple[Column, ...]:
    flags = {
        "long_name": "clearance joint",
        "flag_values": list(range(len(joints))),
        "flag_meanings": " ".join(name.replace(" ", "_") for name in joints),
    }
    measured = (
        Column(name, IMPACT[name], {"units": unit, "long_name": long_name})
        for name, (unit, long_name) in _IMPACT_MEANING.items()
    )
    return (Column("joint", IMPACT["joint"], flags), *measured)
