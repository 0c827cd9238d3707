"""Restart points on disk: a small file for each attempt at a run, replaced as it advances."""

from dataclasses import dataclass
from pathlib import Path
from typing import Self

from jointplay.records.checkpoint import UnusableCheckpoint, decode, encode, packed
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage import durable

_KIND = "simulation and its results"


@dataclass(frozen=True)
class RestartPoint:
    """Simulation and results store at one instant; both are needed to go on from it."""

    simulation: bytes
    results: bytes
    folder: Path  # of the store that `results` belongs to, beside the restart point
    watermark: int  # samples readers may see: all so far, as `results` brought them to the disk
    time: float  # simulated time [s]
    fraction: float  # 0..1

    def store(self, path: Path) -> None:
        """Write it so that after a power cut the file is the old or the new one."""
        facts = {"watermark": self.watermark, "time": self.time, "fraction": self.fraction}
        parts = {"simulation": packed(self.simulation), "results": packed(self.results)}
        folder = {"folder": self.folder.name}
        durable.write(path, [encode(_KIND, SOLVER_VERSION, facts | folder, parts)])

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read what `store` wrote.

        Raises
        ------
        UnusableCheckpoint
            The file is missing, damaged, or another solver's, whose bits would differ.
        """
        try:
            found = decode(path.read_bytes(), _KIND, SOLVER_VERSION)
        except OSError as error:
            raise UnusableCheckpoint(f"{path.name} cannot be read: {error}") from error
        name = str(found.facts["folder"])
        if name in ("", ".", "..") or Path(name).name != name:
            raise UnusableCheckpoint(f"{path.name} names a store {name!r}, which is none beside it")
        facts = found.facts | {"folder": path.parent / name}
        return cls(found.content("simulation"), found.content("results"), **facts)
