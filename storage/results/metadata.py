"""The zarr.json documents of a store.

They are filled in from one template rather than made array by array through zarr, and every
group carries the consolidated metadata of what lies below it: without it stock clients that
cannot list a folder (over HTTP) show an empty dataset.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, cached_property
from json.encoder import encode_basestring_ascii as _quoted
from typing import Any, Final

import numpy as np

from jointplay.storage.results.shards import COMPRESSION_LEVEL, COMPRESSOR, fill

Document = dict[str, Any]

FILE: Final = "zarr.json"
DOUBLE: Final = np.dtype("<f8")
_MEMBERS: Final = "consolidated_metadata"
_EMPTY: Final = "{}}}"
"""End of a group's document without members, which stand last in it."""
_BYTES_CODEC: Final = {"name": "bytes", "configuration": {"endian": "little"}}


def documents(attributes: Mapping[str, Any], nodes: Mapping[str, Document]) -> dict[str, Document]:
    """Make every document of a store by its key: of arrays, then of groups, the root's last.

    Parameters
    ----------
    attributes
        Of the root.
    nodes
        Arrays, and groups without their members, by path.
    """
    arrays = {path: node for path, node in nodes.items() if node["node_type"] == "array"}
    written = {f"{path}/{FILE}": array for path, array in arrays.items()}
    for path, node in nodes.items():
        if node["node_type"] == "group":
            begin = f"{path}/"
            below = {p.removeprefix(begin): one for p, one in arrays.items() if p.startswith(begin)}
            written[begin + FILE] = group(node["attributes"], below)
    return written | {FILE: group(attributes, nodes)}


def groups_among(documents: Mapping[str, Document]) -> dict[str, Document]:
    """Choose the groups' documents, which hold those of the arrays: what a growing store shows."""
    return {key: one for key, one in documents.items() if one["node_type"] == "group"}


def arrays_among(documents: Mapping[str, Document]) -> dict[str, Document]:
    """Choose the arrays' documents, by the path of each."""
    return {
        key.removesuffix(f"/{FILE}"): one
        for key, one in documents.items()
        if one["node_type"] == "array"
    }


def shape_of(array: Document) -> tuple[int, int]:
    """Give rows of a file and of a chunk of an array's document."""
    rows, *_ = array["chunk_grid"]["configuration"]["chunk_shape"]
    first = array["codecs"][0]
    if first["name"] != "sharding_indexed":
        return int(rows), int(rows)
    chunk_rows, *_ = first["configuration"]["chunk_shape"]
    return int(rows), int(chunk_rows)


def serialise(document: Mapping[str, Any]) -> bytes:
    """Give the bytes of a document: the same for the same document, everywhere.

    Raises
    ------
    ValueError
        A number in it is not finite.
    """
    return _text(document).encode()


def serialised(documents: Mapping[str, Document]) -> Iterator[tuple[str, bytes]]:
    """Give key and bytes of each document, as `serialise` does."""
    for key, document in documents.items():
        yield key, _with_members(document).encode()


_text: Final = json.JSONEncoder(separators=(",", ":"), allow_nan=False).encode


class _Array(Document):
    """Document of an array, which is written once: those of the groups above it hold it, too."""

    @cached_property
    def text(self) -> str:
        return _text(self)


def _with_members(document: Document) -> str:
    if isinstance(document, _Array):
        return document.text
    members = document.get(_MEMBERS, {}).get("metadata")
    if not members:
        return _text(document)
    alone = _text(document | {_MEMBERS: document[_MEMBERS] | {"metadata": {}}})
    inside = ",".join([f"{_quoted(path)}:{_with_members(one)}" for path, one in members.items()])
    return f"{alone.removesuffix(_EMPTY)}{{{inside}}}}}}}"


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

    It must not be changed.

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
    return _Array(
        {
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
    )


def group(attributes: Mapping[str, Any], members: Mapping[str, Document]) -> Document:
    """Make the document of a group, with those of what lies below it."""
    below = {"kind": "inline", "must_understand": False, "metadata": members}
    return {
        "zarr_format": 3,
        "node_type": "group",
        "attributes": attributes,
        _MEMBERS: below,
    }


@cache
def _name(dtype: np.dtype[Any]) -> str:
    return dtype.name  # numpy spells it anew each time, which is most of the cost of a document
