"""Lanes on a device, as a bundle of as many: loaded, extended and read as eight lanes here are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput
from jointplay.records.impact import IMPACT
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.driver import Code, Device
from jointplay.solver.kernels.device.kernel_text import ENTRY
from jointplay.solver.kernels.device.lanes import DeviceLanes, Shape
from jointplay.solver.kernels.device.one_lane import Sizes
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.loop.bundle import Bundle, Group
from jointplay.solver.kernels.loop.problem import LaneProblem
from jointplay.solver.kernels.loop.ready_lanes import ENERGIES
from jointplay.solver.kernels.loop.runs import (
    DTYPE,
    GROWTH,
    NO_PAIR,
    Buffers,
    SectionKind,
    Status,
)

ROWS, IMPACTS, GROWTHS = 80, 64, 16
"""That a lane hands out in a launch at most. Sections at events want room for a step's."""


class DeviceBundle(Bundle):
    """Runs many problems of one structure on a device; lanes do not touch each other.

    All numbers have a copy here, where lanes are loaded and extended. It is sent before a launch if
    something was changed, and fetched behind one in which a lane came to an end. Of lanes that run
    on, time and steps are up to date between launches, and all else in `state`.
    """

    def __init__(
        self,
        device: Device,
        kernel: Kernel,
        count: int,
        *,
        tangents: Tangents | None = None,
        write: Callable[[Sequence[Source], NDArray[np.void], Sizes], str] = code,
    ) -> None:
        """Take room for so many lanes, and have the driver make code of the kernel; seconds.

        `write` : what writes a kernel's code for the driver.

        Raises
        ------
        InvalidInput
            The kernel's method is none for devices.
        DeviceError
            The device has not enough memory, or takes no such code.
        """
        if isinstance(kernel.tableau, Rosenbrock):
            raise InvalidInput.at("method", "A device computes explicit methods; it must be one.")
        self._beside = Bundle(kernel, watch=False, tangents=tangents)
        self.kernel, self.watch, self.tangents = kernel, False, tangents
        self.width = count
        self.runs = np.zeros(count, DTYPE)
        self.runs["status"], self.runs["landing"] = Status.IDLE, NO_PAIR
        self.first_energy = np.zeros((len(ENERGIES), count))
        sources, places = kernel.module.tapes.sources, kernel.places
        slots = kernel.layout.size
        if tangents is not None:
            sources = [*sources, *tangents.module.tapes.sources]
            places, slots = tangents.places, tangents.layout.size
        growths = 0 if tangents is None else GROWTHS
        work = np.zeros((slots, count))
        none = Buffers.of(0, 0, kernel.row.width, 0, tangents=False, steps=(0, 0, 0))
        self.groups = [Group(work, self.runs, none)]
        sizes = Sizes(0, slots, ROWS, IMPACTS, growths)
        loaded = Code(device, write(sources, places, sizes), ENTRY)
        shape = Shape(slots, kernel.row.width, *sizes[2:], DTYPE, IMPACT, GROWTH)
        self._lanes = DeviceLanes(device, loaded, shape, count)
        self._changed = True
        self._fetched = True
        self._rows: NDArray[Any] = np.zeros(0)
        self._impacts: NDArray[Any] = np.zeros(0)
        self._growths: NDArray[Any] = np.zeros(0)

    def load(self, i: int, problem: LaneProblem, like: int | None = None) -> None:
        """Give a lane that does not run a problem to compute; the other lanes do not notice.

        Raises
        ------
        InvalidInput
            Its sections are where a channel crosses a value, which no device looks for.
        """
        if problem.event is not None and problem.event.kind == SectionKind.CROSSING:
            raise InvalidInput.at("section", "A device takes sections of drivers and onsets.")
        self._beside.load(0, problem)
        self.groups[0].work[:, i] = self._beside.lane(0).work[:, 0]
        self.runs[i] = self._beside.runs[0]
        self.first_energy[:, i] = self._beside.first_energy[:, 0]
        self._changed = True

    def repeat(self, count: int) -> None:
        """Let all lanes be like the first ones, in turn."""
        like = np.arange(self.width) % count
        for array in (self.groups[0].work, self.first_energy):
            array[:] = array[:, like]
        self.runs[:] = self.runs[like]
        self._changed = True

    def set_going(self, i: int) -> None:
        """Let a lane run from where it is to the end that its run has."""
        super().set_going(i)
        self._changed = True

    def advance(self, budget: int) -> int:
        """Attempt at most `budget` steps; how many lanes still run. Rows are handed out once."""
        (group,), lanes = self.groups, self._lanes
        if self._changed:
            self._fetch()
            lanes.columns.write(group.work)
            lanes.runs.write(self.runs)
            self._changed = False
        before = self.runs["status"] == Status.RUNNING
        lanes.launch(budget)
        self._fetched = False
        group.attempts += int(lanes.made().max(initial=0))
        self.runs[:] = lanes.runs.read()
        self._rows = lanes.rows(int(self.runs["filled"].max(initial=0)))
        self._impacts = lanes.impacts(int(self.runs["impacts"].max(initial=0)))
        self._growths = lanes.growths(int(self.runs["growths"].max(initial=0)))
        running = self.runs["status"] == Status.RUNNING
        if (before & ~running).any():
            self._fetch()
        else:
            for name in ("time", "steps"):
                slot = self.kernel.layout[name]
                group.work[slot] = lanes.columns.row(slot)
        return int(np.count_nonzero(running))

    def _fetch(self) -> None:
        """Bring the numbers of all lanes here, unless they are."""
        if not self._fetched:
            self.groups[0].work[:] = self._lanes.columns.read()
            self._fetched = True

    def rows(self, kind: int, i: int) -> Floats:
        """Return what a lane handed out in the last call: dense rows (count, width)."""
        found: Floats = self._rows[i, kind, : self.runs["filled"][i, kind]]
        return found

    def impacts(self, i: int) -> NDArray[np.void]:
        """Return the contacts of a lane that ended in the last call, of dtype `IMPACT`."""
        found: NDArray[np.void] = self._impacts[i, : self.runs["impacts"][i]].copy()
        return found

    def growth(self, i: int) -> Floats:
        """Return how a lane's tangent grew in the last call: (k, 2) ends of time, s, logarithms."""
        growths = self._growths[i, : self.runs["growths"][i]]
        return growths.copy().view(np.float64).reshape(-1, 2)

    def observe(self, i: int, rows: Floats, columns: NDArray[np.int64]) -> Floats:
        """Return channels (rows, columns) of a lane at rows of dense state, by this processor."""
        self._beside.lane(0).work[:, 0] = self.groups[0].work[:, i]
        return self._beside.observe(0, rows, columns)

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return everything that the next step depends on, as a bundle of as many lanes here."""
        self._fetch()
        return super().state(name)

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        super().restore(saved, name)
        self._changed = self._fetched = True
