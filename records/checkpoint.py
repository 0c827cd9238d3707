"""Checkpoint of a computation, to continue it: facts and arrays as bytes, and back.

A checkpoint begins with a line that names the format and one with the SHA-256 of all that follows:
a line of JSON (kind, version, facts, names and sizes of the arrays), then the arrays in NumPy's
format. The same facts and arrays give the same bytes.
"""

import json
from collections.abc import Mapping
from hashlib import sha256
from io import BytesIO
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

_MAGIC: Final = b"jointplay checkpoint 1"


class UnusableCheckpoint(Exception):
    """The bytes cannot be continued from, for the reason that the sentence gives: begin anew."""


class ForeignCheckpoint(UnusableCheckpoint):
    """The bytes are whole, but of something else, or of another version of the program."""


class Checkpoint(NamedTuple):
    """Facts and arrays, as they were given to `encode`."""

    facts: dict[str, Any]
    arrays: dict[str, NDArray[Any]]

    def content(self, name: str) -> bytes:
        """Return bytes that were given as the array `packed(...)`."""
        return self.arrays[name].tobytes()


def packed(content: bytes) -> NDArray[np.uint8]:
    """Return bytes as an array, for bytes inside a checkpoint."""
    return np.frombuffer(content, np.uint8)


def encode(
    kind: str, version: str, facts: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]
) -> bytes:
    """Return a checkpoint's bytes.

    Parameters
    ----------
    kind, version
        Of what was computed, and of the program: another one refuses the checkpoint.
    facts
        JSON values; doubles come back bit for bit, also those that are not finite.
    arrays
        Of numbers, of any shape, by name; records too.
    """
    members = {name: _member(array) for name, array in arrays.items()}
    sizes = {name: len(member) for name, member in members.items()}
    header = {"kind": kind, "version": version, "facts": dict(facts), "arrays": sizes}
    content = (
        json.dumps(header, separators=(",", ":")).encode() + b"\n" + b"".join(members.values())
    )
    return b"\n".join((_MAGIC, sha256(content).hexdigest().encode(), content))


def decode(content: bytes, kind: str, version: str) -> Checkpoint:
    """Read a checkpoint; its arrays may be written to.

    Raises
    ------
    UnusableCheckpoint
        It is damaged, or (`ForeignCheckpoint`) of something else or another version of the program,
        whose bits would differ.
    """
    try:
        magic, digest, rest = content.split(b"\n", 2)
        intact = magic == _MAGIC and sha256(rest).hexdigest() == digest.decode()
        line, body = rest.split(b"\n", 1) if intact else (b"", b"")
    except ValueError:
        intact = False
    if not intact:
        raise UnusableCheckpoint("the checkpoint is damaged, or none of this program")
    header = json.loads(line)
    if header["kind"] != kind:
        raise ForeignCheckpoint(f"the checkpoint is one of {header['kind']}, not of {kind}")
    if header["version"] != version:
        raise ForeignCheckpoint(
            f"the checkpoint was made by version {header['version']}, this one is {version}"
        )
    arrays, begin = {}, 0
    for name, size in header["arrays"].items():
        member = BytesIO(body[begin : begin + size])
        arrays[name] = np.lib.format.read_array(member, allow_pickle=False)
        begin += size
    return Checkpoint(header["facts"], arrays)


def _member(array: NDArray[Any]) -> bytes:
    buffer = BytesIO()
    np.lib.format.write_array(buffer, np.asarray(array), allow_pickle=False)
    return buffer.getvalue()
