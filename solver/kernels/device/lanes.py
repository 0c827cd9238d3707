"""Lanes on a device: their numbers there, launches, and what these hand out."""

from typing import Any, NamedTuple

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


class Sizes(NamedTuple):
    """Number of lanes, and how much each has."""

    lanes: int
    slots: int
    rows: int
    """That a launch hands out at most; further ones in the next. Of the others, too."""
    impacts: int
    growths: int
    """0: there are no tangents."""


class DeviceLanes:
    """Lanes of one kernel on a device."""

    def __init__(
        self,
        device: Device,
        code: Code,
        sizes: Sizes,
        width: int,
        kinds: tuple[Any, Any, Any],
        block: int = BLOCK,
    ) -> None:
        """Take memory for them.

        `width` : numbers of a row; `kinds` : types of a run, an impact and a growth; `block` :
        threads that keep together.

        Raises
        ------
        DeviceError
            There is not enough.
        """
        self.device, self.code, self.sizes = device, code, sizes
        self._width, self._block = width, block
        (count, slots, rows, impacts, growths), (run, impact, growth) = sizes, kinds
        self._words = int(np.dtype(run).itemsize // WORD)
        self._all: list[Memory] = []
        try:
            self.columns = self._memory((slots, count), np.float64)
            self.runs = self._memory((count,), run)
            self._rows = self._memory((count, 2, rows * width), np.float64)
            self.impacts = self._memory((count, impacts), impact)
            self.growths = self._memory((count, growths), growth)
            self.made = self._memory((count,), np.int64)
            """Attempts of each lane in the last launch, once that is done."""
            self._arguments = [memory.address for memory in self._all]
            self._which = self._memory((PACKED,), np.int64)
            words = max(slots, self._words)
            self._packed = self._memory((words * min(count, PACKED),), np.int64)
        except BaseException:
            self.release()
            raise

    def _memory(self, shape: tuple[int, ...], kind: Any) -> Memory:
        self._all.append(Memory(self.device, shape, kind))
        return self._all[-1]

    def launch(self, budget: int) -> None:
        """Begin at most so many attempts of each lane."""
        count = self.sizes.lanes
        self.code.launch(ENTRY, count, self._block, [*self._arguments, count, budget])

    def fetch(self, lanes: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return numbers (slots, lanes) of some lanes."""
        slots = self.sizes.slots
        columns = np.empty((slots, len(lanes)))
        for first in range(0, len(lanes), PACKED):
            some = lanes[first : first + PACKED]
            self._move(self.columns, some, (self.sizes.lanes, 1), slots * len(some), into=0)
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
            self._move(self.columns, some, (self.sizes.lanes, 1), own.size, into=1)
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
        return self._rows.read(most * self._width).reshape(self.sizes.lanes, 2, most, self._width)

    def release(self) -> None:
        """Give the memory back."""
        for memory in self._all:
            memory.release()
