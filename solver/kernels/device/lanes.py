"""Lanes on a device: their numbers there, launches, and what these hand out."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.device.driver import Code, Device, Memory

BLOCK = 256
"""Threads that keep together, attempt by attempt: they share what they fetch of the code."""


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
    """Types of these records."""


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
        self._all: list[Memory] = []
        try:
            self.columns = self._memory((shape.slots, count), np.float64)
            self.runs = self._memory((count,), shape.run)
            self._rows = self._memory((count, 2, shape.rows * shape.width), np.float64)
            self._impacts = self._memory((count, shape.impacts), shape.impact)
            self._growths = self._memory((count, shape.growths), shape.growth)
            self._made = self._memory((count,), np.int64)
        except BaseException:
            self.release()
            raise

    def _memory(self, shape: tuple[int, ...], kind: Any) -> Memory:
        self._all.append(Memory(self.device, shape, kind))
        return self._all[-1]

    def launch(self, budget: int) -> None:
        """Begin at most so many attempts of each lane."""
        addresses = [memory.address for memory in self._all]
        self.code.launch(self.count, self._block, [*addresses, self.count, budget])

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
