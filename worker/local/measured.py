"""Measured candidates of a calibration in a file: one that was cut short measures none twice.

The search and the spread ask for the same candidates again, bit for bit, since both follow from
the document; what the file has is then read and not computed.  A line of JSON names the
calibration and the version of the solver; behind it stands a frame for each answer: its length, its
CRC-32, and candidates and values as a checkpoint.  A frame that is not whole ends the file.
"""

import hashlib
import json
import struct
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, Final
from zlib import crc32

from jointplay.records.arrays import Floats
from jointplay.records.checkpoint import UnusableCheckpoint, decode, encode
from jointplay.solver.calibration.measure import Measure
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.version import SOLVER_VERSION

_KIND: Final = "measured candidates"
_FRAME: Final = struct.Struct("<II")


class Measured:
    """Candidates that one calibration measured so far, and the file that they are kept in.

    Parameters
    ----------
    path
        Of the file; one of something else is replaced.
    """

    def __init__(self, path: Path, calibration: Calibration) -> None:
        self._path = path
        self._known: dict[tuple[bool, bytes], Floats] = {}
        head = _head(calibration)
        content = path.read_bytes() if path.exists() else b""
        if content.startswith(head):
            whole = len(head)
            for end, every, candidates, values in _frames(content, len(head)):
                self._known[_key(candidates, every=every)] = values
                whole = end
            with path.open("r+b") as file:
                file.truncate(whole)
        else:
            path.write_bytes(head)

    def of(self, measure: Measure, *, every: bool) -> Measure:
        """Return a measure that computes only what is not known, and keeps it."""

        def measured(candidates: Floats) -> Floats:
            key = _key(candidates, every=every)
            if key not in self._known:
                self._known[key] = values = measure(candidates)
                self._keep(candidates, values, every=every)
            return self._known[key]

        return measured

    def _keep(self, candidates: Floats, values: Floats, *, every: bool) -> None:
        arrays = {"candidates": candidates, "values": values}
        frame = encode(_KIND, SOLVER_VERSION, {"every": every}, arrays)
        with self._path.open("ab") as file:
            file.write(_FRAME.pack(len(frame), crc32(frame)) + frame)


def document_in(path: Path) -> dict[str, Any] | None:
    """Return the calibration that a file was begun for; None if there is no such file."""
    with suppress(OSError, ValueError, KeyError), path.open("rb") as file:
        found = json.loads(file.readline())["calibration"]
        return found if isinstance(found, dict) else None
    return None


def _head(calibration: Calibration) -> bytes:
    head = {"solver": SOLVER_VERSION, "calibration": calibration.document}
    return json.dumps(head).encode() + b"\n"


def _frames(content: bytes, begin: int) -> Iterator[tuple[int, bool, Floats, Floats]]:
    """Yield where each whole frame ends, and what is in it."""
    while begin + _FRAME.size <= len(content):
        length, checksum = _FRAME.unpack_from(content, begin)
        begin += _FRAME.size
        frame = content[begin : begin + length]
        if len(frame) < length or crc32(frame) != checksum:
            return
        begin += length
        try:
            facts, arrays = decode(frame, _KIND, SOLVER_VERSION)
        except UnusableCheckpoint:
            return
        yield begin, facts["every"], arrays["candidates"], arrays["values"]


def _key(candidates: Floats, *, every: bool) -> tuple[bool, bytes]:
    return every, hashlib.sha256(candidates.tobytes()).digest()
