"""A bundle: up to eight runs of one kernel, their state, and the rows that they hand out."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.kernel import CompiledAddress, Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.advance import advance
from jointplay.solver.kernels.loop.beginning import begin
from jointplay.solver.kernels.loop.binding import FIRST_STEP, bind
from jointplay.solver.kernels.loop.clock import product_difference
from jointplay.solver.kernels.loop.extreme import SIZE as TABLE_SIZE
from jointplay.solver.kernels.loop.observation import observe_rows
from jointplay.solver.kernels.loop.periods import look_ahead, plan
from jointplay.solver.kernels.loop.problem import LaneProblem, LaneStart
from jointplay.solver.kernels.loop.state import Counter, SectionKind, Setting, Status, row_width
from jointplay.solver.scene.document import Scene

Floats = NDArray[np.float64]

ROWS_AT_ONCE = 2048
"""Capacity of each row buffer: how many samples a lane hands out between returns to Python."""
ENERGIES = ("energy.kinetic", "energy.potential", "stored")
STATE = ("work", "settings", "counters", "first_energy")
"""Arrays of a bundle that the next step, or what is said of the run, depends on."""


class Bundle:
    """Runs up to eight problems of one structure side by side; lanes do not touch each other."""

    def __init__(
        self,
        kernel: Kernel,
        problems: Sequence[LaneProblem] = (),
        *,
        watch: bool = True,
        tangents: Tangents | None = None,
    ) -> None:
        """Load the problems.

        `watch` says whether extremes of channels are sought. With the kernel's `tangents` every
        lane carries a tangent vector, and `growth_rows` tells how it grows; nothing else changes.
        """
        if len(problems) > LANES:
            raise ValueError(f"a bundle holds {LANES} problems, not {len(problems)}")
        self.kernel = kernel
        self.watch = watch
        self.attempts = 0
        """Attempts at a step that were made, each of all lanes at once."""
        self.tangents = tangents
        self.layout = kernel.layout if tangents is None else tangents.layout
        self.slots = kernel.slots if tangents is None else tangents.slots
        self.work = aligned_zeros(self.layout.size * LANES)
        self.spare = aligned_zeros(kernel.layout.size * LANES)
        drivers, joints = len(kernel.drivers), len(kernel.play)
        self.settings = np.zeros((Setting.FIRST_DRIVER + 2 * drivers, LANES))
        self.counters = np.zeros((Counter.COUNT, LANES), dtype=np.int64)
        self.counters[Counter.STATUS] = Status.IDLE
        self.counters[Counter.LANDING] = -1
        self.first_energy = np.zeros((len(ENERGIES), LANES))
        width = row_width(drivers, kernel.states, joints)
        self.sample_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.section_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.impact_rows = np.zeros((LANES, ROWS_AT_ONCE, 6))
        self.growth_rows = np.zeros((LANES, 0 if tangents is None else ROWS_AT_ONCE, 2))
        self.table_of_extremes = np.zeros(TABLE_SIZE)
        for lane, problem in enumerate(problems):
            self.load(lane, problem)

    def load(self, lane: int, problem: LaneProblem, like: int | None = None) -> None:
        """Give a lane that does not run a problem to compute; the other lanes do not notice.

        `like` is a lane that has the problem's scene already, which saves looking at it again.

        Lanes that never had one repeat this one's numbers: harmless, unlike zeros.
        """
        bind(self, lane, problem, like)
        fresh = self.counters[Counter.STATUS] == Status.IDLE
        fresh[lane] = False
        self.work.reshape(-1, LANES)[:, fresh] = self.work.reshape(-1, LANES)[:, [lane]]
        self.table("active")[0, fresh] = 0.0
        begin(self, lane, problem)
        self._run(lane)
        self.first_energy[:, lane] = self.energy(lane)

    def number_like(self, other: Bundle, lane: int, scene: Scene) -> None:
        """Give the first lane the numbers of a scene that a lane of another bundle has already."""
        work = self.work.reshape(-1, LANES)
        work[: self.kernel.layout.size, 0] = other.work.reshape(-1, LANES)[:, lane]
        if self.tangents is not None:
            slots = [slot for slot, _ in self.tangents.fixed]
            work[slots, 0] = self.tangents.fixed_values(scene)

    def extend(self, lane: int, duration: float, sections: int, *, forget: bool = False) -> None:
        """Let a lane that is done go on to a later end; `forget` its extremes so far.

        Parameters
        ----------
        duration
            From the lane's start, s.
        sections
            As in `LaneProblem`.
        """
        at, lanes = self.kernel.layout, self.work.reshape(-1, LANES)[:, lane]
        setting, counter = self.settings[:, lane], self.counters[:, lane]
        setting[Setting.DURATION] = duration
        whole, period = float(counter[Counter.PERIOD]), setting[Setting.PERIOD]
        lanes[at["end"]] = product_difference(duration, 1.0, whole, period)
        counter[Counter.SECTIONS] = sections
        if forget:
            rows, now = self.kernel.rows.scanned, self.time(lane)
            for record in ("highest", "lowest"):
                first, first_time = at[f"{record}0"], at[f"{record}_time0"]
                lanes[first : first + rows] = lanes[at["previous0"] : at["previous0"] + rows]
                lanes[first_time : first_time + rows] = now
            lanes[at["change0"] : at["change0"] + rows] = math.nan
            # no change is known before the next step: a long one could hide an extreme
            lanes[at["step"]] = FIRST_STEP * period
        self._run(lane)

    def _run(self, lane: int) -> None:
        """Set a lane going."""
        self.counters[Counter.STATUS, lane] = Status.RUNNING
        self.table("active")[0, lane] = 1.0
        for kind in range(2):
            look_ahead(kind, lane, self.kernel.slots, self.work, self.settings, self.counters)
        plan(lane, self.kernel.slots, self.work, self.settings)

    def table(self, name: str, count: int = 1) -> Floats:
        """Return a view (count, LANES) of a block of the work array."""
        first = self.layout[name]
        return self.work.reshape(-1, LANES)[first : first + count]

    def advance(self, budget: int) -> int:
        """Attempt at most `budget` steps; how many lanes still run. Rows are handed out once.

        Comes back early when a lane ends or has as many rows as it can hold.
        """
        self.counters[Counter.SAMPLE_ROWS :] = 0
        self.attempts += int(
            advance(
                *self.kernel.functions,
                *self._tangent_functions(),
                self.slots,
                self.work,
                self.spare,
                self.settings,
                self.counters,
                self.table_of_extremes,
                self.sample_rows,
                self.section_rows,
                self.impact_rows,
                self.growth_rows,
                int(self.watch or self._crossing),
                budget,
            )
        )
        return int(np.count_nonzero(self.counters[Counter.STATUS] == Status.RUNNING))

    def _tangent_functions(self) -> tuple[CompiledAddress, CompiledAddress]:
        if self.tangents is None:  # any two: they are not called
            return self.kernel.functions[1], self.kernel.functions[2]
        return self.tangents.functions

    def growth(self, lane: int) -> Floats:
        """Return how a lane's tangent grew in this call: (k, 2) ends of time, s, and logarithms."""
        return self.growth_rows[lane, : self.counters[Counter.GROWTH_ROWS, lane]]

    def observe(self, lane: int, rows: Floats, columns: NDArray[np.int64]) -> Floats:
        """Return channels (rows, columns) of a lane at rows of dense state."""
        out = np.empty((len(rows), len(columns)))
        observe_rows(
            *self.kernel.observing,
            self.kernel.slots,
            self.work,
            self.spare,
            lane,
            rows,
            columns,
            out,
        )
        return out

    def state_of(self, lane: int) -> LaneStart:
        """Return where a lane is, for another problem to start from."""
        joints = len(self.kernel.play)
        return LaneStart(
            self.table("y0", self.kernel.states)[:, lane].copy(),
            self.table("mode0", joints)[:, lane] > 0.0 if joints else np.zeros(0, dtype=bool),
            self.table("impact_rate0", joints)[:, lane].copy() if joints else np.zeros(0),
        )

    def energy(self, lane: int) -> Floats:
        """Return a lane's kinetic, potential and stored elastic energy, J."""
        kernel, lanes = self.kernel, self.work.reshape(-1, LANES)
        drivers, joints = len(kernel.drivers), len(kernel.play)
        row = [float(self.counters[Counter.PERIOD, lane]), self.table("time")[0, lane]]
        phases = kernel.layout["phase0"] if drivers else 0
        row += [
            *lanes[phases : phases + 2 * drivers, lane],
            *self.table("y0", kernel.states)[:, lane],
        ]
        for j in range(joints):
            row += [self.table(f"mode{j}")[0, lane], self.table(f"impact_rate{j}")[0, lane]]
        columns = np.array([kernel.rows.index(name) for name in ENERGIES], dtype=np.int64)
        return self.observe(lane, np.array([row]), columns)[0]

    @property
    def _crossing(self) -> bool:
        return bool(np.any(self.settings[Setting.SECTION_KIND] == SectionKind.CROSSING))

    def time(self, lane: int) -> float:
        """Return the simulated time that a lane has reached, s."""
        whole = int(self.counters[Counter.PERIOD, lane])
        local = float(self.table("time")[0, lane])
        return whole * float(self.settings[Setting.PERIOD, lane]) + local

    def state(self) -> bytes:
        """Return everything that the next step depends on."""
        buffer = io.BytesIO()
        np.savez(buffer, **{name: getattr(self, name) for name in STATE})
        return buffer.getvalue()

    def restore(self, state: bytes) -> None:
        """Continue from `state`, bit for bit."""
        with np.load(io.BytesIO(state), allow_pickle=False) as saved:
            for name in STATE:
                getattr(self, name)[:] = saved[name]


def aligned_zeros(size: int) -> Floats:
    """Return zeros that begin on a cache line: else every row of eight lanes straddles two."""
    line = 64
    padded = np.zeros(size + line // 8)
    skip = (-padded.ctypes.data % line) // 8
    return padded[skip : skip + size]
