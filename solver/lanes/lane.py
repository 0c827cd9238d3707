"""One lane of a work array, seen by the names of its slots."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.loop.runs import NO_PAIR, RUNNING, Status


@dataclass(frozen=True)
class Lane:
    """A lane with its run: ``lane["y"]`` is a view of that block, which can be set."""

    kernel: Kernel
    tangents: Tangents | None
    work: Floats
    """(slots, lanes) of all lanes beside it, too."""
    index: int | slice
    """Column of the work array; or all of them: then blocks are (slots, lanes)."""
    run: Any
    """The lane's run, of type `Run`, or (lanes,); its fields can be set by name."""

    @property
    def slots(self) -> NDArray[np.void]:
        """Named slots, (1,); see `solver.kernels.emit.slots`."""
        return (self.tangents or self.kernel).slots

    @property
    def column(self) -> Floats:
        """All its numbers, (slots,), which can be set."""
        return self.work[:, self.index]

    def __getitem__(self, name: str) -> Floats:
        return self.work[(self.tangents or self.kernel).layout.block(name), self.index]

    def __setitem__(self, name: str, value: NDArray[Any] | float) -> None:
        self[name][:] = value

    def number(self, name: str) -> float:
        """Return the value of a single slot."""
        return float(self[name][0])

    @property
    def status(self) -> Status:
        """Status of the lane."""
        return Status(self.run["status"])

    @property
    def running(self) -> bool:
        """Whether it has not come to its end."""
        return bool(self.run["status"] == RUNNING)

    @property
    def time(self) -> float:
        """Simulated time that it has reached, s."""
        return int(self.run["periods"]) * float(self.run["period"]) + self.number("time")

    @property
    def steps(self) -> int:
        """Accepted steps."""
        return int(self.number("steps"))

    @property
    def attempts(self) -> int:
        """Steps accepted or rejected: the lane's own, whatever the others do."""
        return self.steps + int(self.run["rejections"])

    def end(self, status: Status) -> None:
        """Let it run no more."""
        self.run["status"], self.run["landing"] = status, NO_PAIR
        self["active"] = self["accept"] = 0.0

    def row(self) -> Floats:
        """Return its state as a dense row, (1, width)."""
        clock = np.array([float(self.run["periods"]), self.number("time")])
        state = (self[name] for name in ("phase", "wound", "y", "mode", "impact_rate"))
        return np.concatenate([clock, *state])[None]


def aligned_zeros(slots: int, columns: int) -> Floats:
    """Return zeros (slots, columns) that begin on a cache line: else rows straddle two."""
    line, size = 64, slots * columns
    padded = np.zeros(size + line // 8)
    skip = (-padded.ctypes.data % line) // 8
    return padded[skip : skip + size].reshape(slots, columns)
