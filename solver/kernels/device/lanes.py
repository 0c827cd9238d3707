"""Lanes on a device: their numbers there, launches, and what these hand out."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.device.driver import Code, Device, Memory

BLOCK = 256
"""Threads that keep together, attempt by attempt: they share what they fetch of the code."""
MOVE = "move"
"""The kernel that brings numbers of some lanes together; see `kernel_text`."""
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
        self._mover = code.other(MOVE)
        self._all: list[Memory] = []
        try:
            self.columns = self._memory((shape.slots, count), np.float64)
            self.runs = self._memory((count,), shape.run)
            self._rows = self._memory((count, 2, shape.rows * shape.width), np.float64)
            self._impacts = self._memory((count, shape.impacts), shape.impact)
            self._growths = self._memory((count, shape.growths), shape.growth)
            self._made = self._memory((count,), np.int64)
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
        self.code.launch(self.count, self._block, [*self._arguments, self.count, budget])

    @property
    def _words(self) -> int:
        return int(np.dtype(self.shape.run).itemsize // WORD)

    def fetch(self, lanes: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.void]]:
        """Return numbers (slots, lanes) and runs (lanes,) of some lanes."""
        slots, words = self.shape.slots, self._words
        columns = np.empty((slots, len(lanes)))
        runs = np.empty(len(lanes), self.shape.run)
        for first in range(0, len(lanes), PACKED):
            some = lanes[first : first + PACKED]
            part = slice(first, first + len(some))
            self._move(self.columns, some, (self.count, 1), slots * len(some), into=0)
            columns[:, part] = self._packed.first((slots, len(some))).view(np.float64)
            self._move(self.runs, some, (1, words), words * len(some), into=0)
            own = np.ascontiguousarray(self._packed.first((words, len(some))).T)
            runs[part] = own.view(self.shape.run)[:, 0]
        return columns, runs

    def send(
        self, lanes: NDArray[np.int64], columns: NDArray[np.float64], runs: NDArray[np.void]
    ) -> None:
        """Set numbers (slots, lanes) and runs (lanes,) of some lanes."""
        words = self._words
        for first in range(0, len(lanes), PACKED):
            some = lanes[first : first + PACKED]
            part = slice(first, first + len(some))
            own = np.ascontiguousarray(columns[:, part])
            self._packed.begin_with(own.view(np.int64))
            self._move(self.columns, some, (self.count, 1), own.size, into=1)
            packed = np.ascontiguousarray(runs[part]).view(np.int64).reshape(len(some), words)
            self._packed.begin_with(packed.T)
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
        self._which.begin_with(lanes)
        addresses = memory.address, self._packed.address, self._which.address
        self._mover.launch(size, BLOCK, [*addresses, *strides, len(lanes), size, into])

    def made(self) -> NDArray[np.int64]:
        """Return how many attempts each lane made in the last launch, once that is done."""
        return self._made.read()

    def rows(self, most: int) -> NDArray[np.float64]:
        """Return the first samples and sections of all lanes, (lanes, 2, most, width)."""
        width = self.shape.width
        return self._rows.read(most * width).reshape(self.count, 2, most, width)

    def impacts(self, most: int) -> NDArray[Any]:
        """Return the first impacts of all lanes, (lanes, most)."""
        return self._impacts.read(most)

    def growths(self, most: int) -> NDArray[Any]:
        """Return the first growths of all lanes, (lanes, most)."""
        return self._growths.read(most)

    def release(self) -> None:
        """Give the memory back."""
        for memory in self._all:
            memory.release()
