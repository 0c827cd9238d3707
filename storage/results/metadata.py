"""The zarr.json documents of a store.

They are filled in from one template rather than made array by array through zarr, and every
group carries the consolidated metadata of what lies below it: without it stock clients that
cannot list a folder (over HTTP) show an empty dataset.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.shards import COMPRESSION_LEVEL, COMPRESSOR, fill
from jointplay.storage.results.tables import Column, Table, tables

Document = dict[str, Any]

FILE: Final = "zarr.json"
_BYTES_CODEC: Final = {"name": "bytes", "configuration": {"endian": "little"}}


def documents(
    layout: ResultLayout,
    rows: Sequence[int],
    attributes: Mapping[str, Any],
    more: Mapping[str, Document] = MappingProxyType({}),
) -> dict[str, Document]:
    """Make every document of a store by its key; the root's comes last.

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
    written: dict[str, Document] = {f"{path}/{FILE}": node for path, node in more.items()}
    members: dict[str, Document] = dict(more)
    groups: dict[str, Document] = {}
    for table, count in zip(tables(layout), rows, strict=True):
        arrays = {column.name: _column(column, table, count) for column in table.columns}
        written |= {f"{table.key(name)}/{FILE}": array for name, array in arrays.items()}
        if table.group:
            groups[table.group] = group(table.attributes, arrays)
            members[table.group] = group(table.attributes, {})
            members |= {table.key(name): array for name, array in arrays.items()}
            written[f"{table.group}/{FILE}"] = groups[table.group]
        else:
            members |= arrays
            own = table.attributes
    written[FILE] = group({**layout.attributes, **own, **attributes}, members)
    return written


def serialise(document: Mapping[str, Any]) -> bytes:
    """Give the bytes of a document: the same for the same document, everywhere.

    Raises
    ------
    ValueError
        A number in it is not finite.
    """
    return json.dumps(document, separators=(",", ":"), allow_nan=False).encode()


def array(
    shape: Sequence[int],
    chunk: Sequence[int],
    dtype: np.dtype[Any],
    dimensions: Sequence[str],
    attributes: Mapping[str, Any],
    *,
    shard: Sequence[int] | None = None,
) -> Document:
    """Make the document of one array whose chunks are compressed as `shards.compress` does.

    Parameters
    ----------
    shape, chunk
        Of the array, and of what is compressed together.
    dtype
        Little-endian doubles or integers.
    dimensions, attributes
        Names of the dimensions; units and meaning.
    shard
        Shape of one file, a whole number of chunks; none: a file is a chunk.
    """
    blosc = {
        "typesize": dtype.itemsize,
        "cname": COMPRESSOR,
        "clevel": COMPRESSION_LEVEL,
        "shuffle": "shuffle",
        "blocksize": 0,
    }
    codecs: list[Document] = [_BYTES_CODEC, {"name": "blosc", "configuration": blosc}]
    if shard is not None:
        sharding = {
            "chunk_shape": list(chunk),
            "codecs": codecs,
            "index_codecs": [_BYTES_CODEC, {"name": "crc32c"}],
            "index_location": "end",
        }
        codecs = [{"name": "sharding_indexed", "configuration": sharding}]
    grid = {"name": "regular", "configuration": {"chunk_shape": list(shard or chunk)}}
    return {
        "zarr_format": 3,
        "node_type": "array",
        "shape": list(shape),
        "data_type": _name(dtype),
        "chunk_grid": grid,
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "fill_value": "NaN" if dtype.kind == "f" else fill(dtype),
        "codecs": codecs,
        "attributes": attributes,
        "dimension_names": list(dimensions),
    }


def group(attributes: Mapping[str, Any], members: Mapping[str, Document]) -> Document:
    """Make the document of a group, with those of what lies below it."""
    below = {"kind": "inline", "must_understand": False, "metadata": members}
    return {
        "zarr_format": 3,
        "node_type": "group",
        "attributes": attributes,
        "consolidated_metadata": below,
    }


@cache
def _name(dtype: np.dtype[Any]) -> str:
    return dtype.name  # numpy spells it anew each time, which is most of the cost of a document


def _column(column: Column, table: Table, rows: int) -> Document:
    whole_chunks = table.chunk_rows == table.shard_rows
    return array(
        [rows],
        [table.chunk_rows],
        column.dtype,
        [table.dimension],
        column.attributes,
        shard=None if whole_chunks else [table.shard_rows],
    )
