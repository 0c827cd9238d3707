"""The zarr.json documents of a store.

They are filled in from one template rather than made array by array through zarr, and every
group carries the consolidated metadata of what lies below it: without it stock clients that
cannot list a folder (over HTTP) show an empty dataset.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Final

from storage.results.layout import ResultLayout
from storage.results.shards import COMPRESSION_LEVEL, COMPRESSOR
from storage.results.tables import Column, Table, tables

Document = dict[str, Any]

FILE: Final = "zarr.json"
_BYTES_CODEC: Final = {"name": "bytes", "configuration": {"endian": "little"}}


def documents(
    layout: ResultLayout, rows: Sequence[int], attributes: Mapping[str, Any]
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
    """
    written: dict[str, Document] = {}
    members: dict[str, Document] = {}
    groups: dict[str, Document] = {}
    for table, count in zip(tables(layout), rows, strict=True):
        arrays = {column.name: _array(column, table, count) for column in table.columns}
        written |= {f"{table.key(name)}/{FILE}": array for name, array in arrays.items()}
        if table.group:
            groups[table.group] = _group(table.attributes, arrays)
            members[table.group] = _group(table.attributes, {})
            members |= {table.key(name): array for name, array in arrays.items()}
            written[f"{table.group}/{FILE}"] = groups[table.group]
        else:
            members |= arrays
            own = table.attributes
    written[FILE] = _group({**layout.attributes, **own, **attributes}, members)
    return written


def serialise(document: Mapping[str, Any]) -> bytes:
    """Give the bytes of a document: the same for the same document, everywhere.

    Raises
    ------
    ValueError
        A number in it is not finite.
    """
    return json.dumps(document, separators=(",", ":"), allow_nan=False).encode()


def _array(column: Column, table: Table, rows: int) -> Document:
    blosc = {
        "typesize": column.dtype.itemsize,
        "cname": COMPRESSOR,
        "clevel": COMPRESSION_LEVEL,
        "shuffle": "shuffle",
        "blocksize": 0,
    }
    codecs: list[Document] = [_BYTES_CODEC, {"name": "blosc", "configuration": blosc}]
    if table.chunk_rows != table.shard_rows:
        sharding = {
            "chunk_shape": [table.chunk_rows],
            "codecs": codecs,
            "index_codecs": [_BYTES_CODEC, {"name": "crc32c"}],
            "index_location": "end",
        }
        codecs = [{"name": "sharding_indexed", "configuration": sharding}]
    grid = {"name": "regular", "configuration": {"chunk_shape": [table.shard_rows]}}
    return {
        "zarr_format": 3,
        "node_type": "array",
        "shape": [rows],
        "data_type": column.dtype.name,
        "chunk_grid": grid,
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "fill_value": column.fill if column.dtype.kind == "i" else "NaN",
        "codecs": codecs,
        "attributes": column.attributes,
        "dimension_names": [table.dimension],
    }


def _group(attributes: Mapping[str, Any], members: Mapping[str, Document]) -> Document:
    below = {"kind": "inline", "must_understand": False, "metadata": members}
    return {
        "zarr_format": 3,
        "node_type": "group",
        "attributes": attributes,
        "consolidated_metadata": below,
    }
