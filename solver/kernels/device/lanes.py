"""Lanes on a device: their numbers there, launches, and what these hand out."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.device.driver import Code, Device, Memory

BLOCK = 256
"""Threads that keep together, attempt by attempt: they share what they fetch of the code."""
ENTRY, MOVE = "advance", "move"
"""The kernel that advances lanes, and one that brings numbers of some together: `kernel_text`."""
WORD = 8
PACKED = 1024
"""Lanes of which numbers are brought together at once."""


@dataclass(frozen=True)
class Shape:
    """Sizes of a lane's parts, and their types."""

    slots: int
    width: int
    """Numbers of a row."""
    rows: int
    """That a launch hands out at most; further ones in the next."""
    impacts: int
    growths: int
    run: Any
    impact: Any
    growth: Any
    """Types of these structures."""


class DeviceLanes:
    """So many lanes of one kernel on a device."""

    def __init__(
        self, device: Device, code: Code, shape: Shape, count: int, block: int = BLOCK
    ) -> None:
        """Take memory for them; so many threads keep together.

        Raises
        ------
        DeviceError
            There is not enough.
        """
        self.device, self.code, self.shape, self.count = device, code, shape, count
        self._block = block
        self._words = int(np.dtype(shape.run).itemsize // WORD)
        self._all: list[Memory] = []
        try:
            self.columns = self._memory((shape.slots, count), np.float64)
            self.runs = self._memory((count,), shape.run)
            self._rows = self._memory((count, 2, shape.rows * shape.width), np.float64)
            self.impacts = self._memory((count, shape.impacts), shape.impact)
            self.growths = self._memory((count, shape.growths), shape.growth)
            self.made = self._memory((count,), np.int64)
            """Attempts of each lane in the last launch, once that is done."""
            self._arguments = [memory.address for memory in self._all]
            self._which = self._memory((PACKED,), np.int64)
            words = max(shape.slots, self._words)
            self._packed = self._memory((words * min(count, PACKED),), np.int64)
        except BaseException:
            self.release()
            raise

    def _memory(self, shape: tuple[int, ...], kind: Any) -> Memory:
        self._all.append(Memory(self.device, shape, kind))
        return self._all[-1]

    def launch(self, budget: int) -> None:
        """Begin at most so many attempts of each lane."""
        arguments = [*self._arguments, self.count, budget]
        self.code.launch(ENTRY, self.count, self._block, arguments)

    def fetch(self, lanes: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return numbers (slots, lanes) of some lanes."""
        slots = self.shape.slots
        columns = np.empty((slots, len(lanes)))
        for first in range(0, len(lanes), PACKED):
            some = lanes[first : first + PACKED]
            self._move(self.columns, some, (self.count, 1), slots * len(some), into=0)
            packed = self._packed.part((slots, len(some)))
            columns[:, first : first + len(some)] = packed.view(np.float64)
        return columns

    def send(
        self, lanes: NDArray[np.int64], columns: NDArray[np.float64], runs: NDArray[np.void]
    ) -> None:
        """Set numbers (slots, lanes) and runs (lanes,) of some lanes."""
        words = self._words
        for first in range(0, len(lanes), PACKED):
            some = lanes[first : first + PACKED]
            part = slice(first, first + len(some))
            own = np.ascontiguousarray(columns[:, part])
            self._packed.write(own.view(np.int64))
            self._move(self.columns, some, (self.count, 1), own.size, into=1)
            packed = np.ascontiguousarray(runs[part]).view(np.int64).reshape(len(some), words)
            self._packed.write(packed.T)
            self._move(self.runs, some, (1, words), packed.size, into=1)

    def _move(
        self,
        memory: Memory,
        lanes: NDArray[np.int64],
        strides: tuple[int, int],
        size: int,
        into: int,
    ) -> None:
        """Bring so many words of some lanes together, or back; see `kernel_text.MOVED`."""
        self._which.write(lanes)
        addresses = memory.address, self._packed.address, self._which.address
        self.code.launch(MOVE, size, BLOCK, [*addresses, *strides, len(lanes), size, into])

    def rows(self, most: int) -> NDArray[np.float64]:
        """Return the first samples and sections of all lanes, (lanes, 2, most, width)."""
        width = self.shape.width
        return self._rows.read(most * width).reshape(self.count, 2, most, width)

    def release(self) -> None:
        """Give the memory back."""
        for memory in self._all:
            memory.release()
