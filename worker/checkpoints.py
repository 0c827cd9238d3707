"""Restart points on disk: a small file for each attempt at a block, replaced as it advances."""

from pathlib import Path

from jointplay.records.checkpoint import UnusableCheckpoint, decode, encode, packed
from jointplay.storage import durable
from jointplay.worker.execute import RestartPoint

_KIND = "simulation and its results"
_FACTS = ("watermark", "time", "fraction")


def store(path: Path, point: RestartPoint, solver_version: str) -> None:
    """Write a restart point so that after a power cut the file is the old or the new one."""
    facts = {name: getattr(point, name) for name in _FACTS} | {"folder": point.folder.name}
    parts = {"simulation": packed(point.simulation), "results": packed(point.results)}
    durable.write(path, [encode(_KIND, solver_version, facts, parts)])


def load(path: Path, solver_version: str) -> RestartPoint:
    """Read a restart point.

    Raises
    ------
    UnusableCheckpoint
        The file is missing, damaged, or another solver's, whose bits would differ.
    """
    try:
        found = decode(path.read_bytes(), _KIND, solver_version)
    except OSError as error:
        raise UnusableCheckpoint(f"{path.name} cannot be read: {error}") from error
    return RestartPoint(
        simulation=found.content("simulation"),
        results=found.content("results"),
        folder=path.parent / found.facts["folder"],
        **{name: found.facts[name] for name in _FACTS},
    )
