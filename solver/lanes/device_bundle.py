"""Lanes on a device, as a bundle of as many: loaded, extended and read as eight lanes here are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import InvalidInput
from jointplay.records.impact import IMPACT
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.driver import Code, Device, DeviceError
from jointplay.solver.kernels.device.lanes import DeviceLanes, Sizes
from jointplay.solver.kernels.device.trimmed import slots_of_energies, without
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.loop.runs import DTYPE, GROWTH, NO_PAIR, Buffers, SectionKind, Status
from jointplay.solver.lanes.bundle import HANDED_OUT, Bundle, GroupState, LaneState
from jointplay.solver.lanes.ready_lanes import ENERGIES

ROWS, IMPACTS, GROWTHS = 80, 64, 16
"""That a lane hands out in a launch at most. Sections at events want room for a step's."""


class DeviceBundle(Bundle):
    """Runs many problems of one structure on a device; lanes do not touch each other.

    All numbers have a copy here, where lanes are loaded and extended. Those of a lane that was
    changed are sent before a launch, and fetched behind the one in which it came to an end. Of
    lanes that run on, time and steps are up to date between launches, and all else in `state`.
    """

    def __init__(
        self,
        device: Device,
        kernel: Kernel,
        count: int,
        *,
        tangents: Tangents | None = None,
        energies: bool = True,
    ) -> None:
        """Take room for so many lanes, and have the driver make code of the kernel; seconds.

        `energies` : whether works and energies are of use; without them steps take three quarters
        of the time.

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
        unused = () if energies else slots_of_energies(kernel)
        sources, of = list(without(unused, kernel.module.sources)), tangents or kernel
        if tangents is not None:
            sources += tangents.module.sources
        work = np.zeros((of.layout.size, count))
        none = Buffers.of(0, 0, kernel.row.width, tangents=False, steps=(0, 0, 0))
        self.groups = [GroupState(work, self.runs, none)]
        sizes = Sizes(count, len(work), ROWS, IMPACTS, 0 if tangents is None else GROWTHS)
        loaded = Code(device, code(sources, of.slots, sizes, on_host=device.on_host))
        kinds = DTYPE, IMPACT, GROWTH
        self._lanes = DeviceLanes(device, loaded, sizes, kernel.row.width, kinds)
        self._changed = np.ones(count, np.bool_)
        self._stale = np.zeros(count, np.bool_)

    def take_up(self, i: int, column: Floats, run: Any, first_energy: Floats) -> None:
        """Give a lane that does not run the state of another, as `Bundle.take_up` does.

        Raises
        ------
        InvalidInput
            Its sections are where a channel crosses a value, which no device looks for.
        """
        if run["section_kind"] == SectionKind.CROSSING:
            raise InvalidInput.at("section", "A device takes sections of drivers and onsets.")
        self.groups[0].work[:, i] = column
        self.runs[i] = run
        self.first_energy[:, i] = first_energy
        self.touched(i)

    def touched(self, i: int) -> None:
        """Note that a lane's numbers here are the newest ones."""
        self._changed[i], self._stale[i] = True, False

    def repeat(self, count: int) -> None:
        """Let all lanes be like the first ones, in turn."""
        like = np.arange(self.width) % count
        for array in (self.groups[0].work, self.first_energy):
            array[:] = array[:, like]
        self.runs[:] = self.runs[like]
        self._changed[:] = True

    def advance(self, budget: int) -> int:
        """Attempt at most `budget` steps.

        Returns how many lanes still run. Rows are handed out once.
        """
        (group,), lanes = self.groups, self._lanes
        launched = self.runs["status"] == Status.RUNNING
        self._send()
        self._stale |= launched
        lanes.launch(budget)
        lanes.device.finish()
        group.attempts += int(lanes.made.read().max(initial=0))
        for name in HANDED_OUT:
            self.runs[name] = 0
        self.runs[launched] = lanes.runs.read()[launched]
        group.buffers = group.buffers._replace(
            rows=lanes.rows(int(self.runs["filled"].max(initial=0))).swapaxes(0, 1),
            impacts=lanes.impacts.read(int(self.runs["impacts"].max(initial=0))),
            growths=lanes.growths.read(int(self.runs["growths"].max(initial=0))),
        )
        running = self.runs["status"] == Status.RUNNING
        self._fetch(launched & ~running)
        for name in ("time", "steps"):
            slot = self.kernel.layout[name]
            reached = lanes.columns.part((self.width,), slot * self.width)
            group.work[slot, launched] = reached[launched]
        return int(np.count_nonzero(launched & running))

    def _send(self) -> None:
        """Send the numbers of lanes that were changed here."""
        work, changed = self.groups[0].work, np.flatnonzero(self._changed)
        if len(changed) == self.width:
            self._lanes.columns.write(work)
            self._lanes.runs.write(self.runs)
        else:
            self._lanes.send(changed, work[:, changed], self.runs[changed])
        self._changed[:] = False

    def _fetch(self, wanted: Flags) -> None:
        """Bring the numbers of lanes here, where they are not."""
        lanes = np.flatnonzero(wanted & self._stale)
        self.groups[0].work[:, lanes] = self._lanes.fetch(lanes)
        self._stale[lanes] = False

    def observe(self, i: int, rows: Floats, columns: NDArray[np.int64]) -> Floats:
        """Return channels (rows, columns) of a lane at rows of dense state, by this processor."""
        self._beside.lane(0).work[:, 0] = self.groups[0].work[:, i]
        return self._beside.observe(0, rows, columns)

    def states_of(self, lanes: Sequence[int]) -> list[LaneState]:
        """Return everything that the next step of some lanes depends on, for `take_up`."""
        wanted = np.zeros(self.width, np.bool_)
        wanted[list(lanes)] = True
        self._fetch(wanted)
        return super().states_of(lanes)

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return everything that the next step depends on, as a bundle of as many lanes here."""
        self._fetch(self._stale)
        return super().state(name)

    def release(self) -> None:
        """Give the device's memory back: there are no lanes any more."""
        with suppress(DeviceError):  # a lost one has given it back
            self._lanes.release()

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        super().restore(saved, name)
        self._changed[:], self._stale[:] = True, False
