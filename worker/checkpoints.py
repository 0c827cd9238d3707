"""Restart points on disk: a small file for each attempt at a block, replaced as it advances."""

import hashlib
import json
import os
from pathlib import Path

from jointplay.worker.execute import RestartPoint

_MAGIC = b"jointplay restart point 1\n"


class UnusableRestartPoint(Exception):
    """A restart point that is damaged or was made by another solver: begin anew."""


def store(path: Path, point: RestartPoint, solver_version: str) -> None:
    """Write a restart point so that after a power cut the file is the old or the new one."""
    body = point.simulation + point.results
    header = {
        "solver_version": solver_version,
        "folder": point.folder.name,
        "watermark": point.watermark,
        "time": point.time,
        "fraction": point.fraction,
        "simulation": len(point.simulation),
        "results": len(point.results),
        "sha256": hashlib.sha256(body).hexdigest(),
    }
    partial = path.with_name(path.name + ".partial")
    with partial.open("wb") as file:
        file.write(_MAGIC + json.dumps(header).encode() + b"\n" + body)
        file.flush()
        os.fsync(file.fileno())
    partial.replace(path)
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


def load(path: Path, solver_version: str) -> RestartPoint:
    """Read a restart point.

    Raises
    ------
    UnusableRestartPoint
        The file is missing, damaged, or another solver's, whose bits would differ.
    """
    try:
        magic, header_line, body = path.read_bytes().split(b"\n", 2)
        header = json.loads(header_line)
        length = header["simulation"]
        intact = hashlib.sha256(body).hexdigest() == header["sha256"]
    except (OSError, ValueError, KeyError) as error:
        raise UnusableRestartPoint(f"{path.name} cannot be read: {error}") from error
    if magic + b"\n" != _MAGIC or not intact:
        raise UnusableRestartPoint(f"{path.name} is damaged")
    if header["solver_version"] != solver_version:
        raise UnusableRestartPoint(
            f"{path.name} was made by solver {header['solver_version']},"
            f" this one is {solver_version}"
        )
    return RestartPoint(
        simulation=body[:length],
        results=body[length:],
        folder=path.parent / header["folder"],
        watermark=header["watermark"],
        time=header["time"],
        fraction=header["fraction"],
    )
