"""A bundle: up to eight runs of one kernel, their state, and the rows that they hand out."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.assembly import assemble, shortest_link
from solver.compiler.kernel import LEDGER, Kernel
from solver.compiler.layout import LANES
from solver.drive import characteristic_time, common_period
from solver.lanes.advance import advance
from solver.lanes.observation import observe_rows
from solver.lanes.peaks import POINTS
from solver.lanes.periods import plan
from solver.lanes.start import mechanism_size, start_state
from solver.lanes.state import Counter, Setting, Status, row_width
from solver.scene.document import Revolute, Scene

Floats = NDArray[np.float64]

ROWS_AT_ONCE = 2048
"""Capacity of each row buffer: how many samples a lane hands out between returns to Python."""
STEPS_IN_A_PERIOD = 100
"""Fewest steps a period: the step grows no longer than that, so that no passing event is missed."""
RESTART = 1e-3
"""The first step in contact closes this share of the clearance at the impact rate."""
SMALLEST_STEP = 1e-15
"""Of a period: a step below it ends the run."""
FIRST_STEP = 1e-6
"""First step, in periods."""


@dataclass(frozen=True)
class LaneProblem:
    """What one lane is to compute."""

    scene: Scene
    duration: float
    tolerance: float
    output_step: float
    samples: int
    sections: int
    section_offset: float


class Bundle:
    """Runs up to eight problems of one structure side by side; lanes do not touch each other."""

    def __init__(self, kernel: Kernel, problems: Sequence[LaneProblem]) -> None:
        if not 1 <= len(problems) <= LANES:
            raise ValueError(f"a bundle holds 1 to {LANES} problems, not {len(problems)}")
        self.kernel = kernel
        self.problems = tuple(problems)
        size = kernel.layout.size * LANES
        self.work, self.spare, self.store = (aligned_zeros(size) for _ in range(3))
        drivers, joints = len(kernel.drivers), len(kernel.play)
        self.settings = np.zeros((Setting.FIRST_DRIVER + 2 * drivers, LANES))
        self.counters = np.zeros((Counter.COUNT, LANES), dtype=np.int64)
        self.counters[Counter.LANDING] = -1
        width = row_width(drivers, kernel.states, joints)
        self.sample_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.section_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.impact_rows = np.zeros((LANES, ROWS_AT_ONCE, 6))
        self.scratch = np.zeros((kernel.rows.scanned + 1, POINTS + 1))
        for lane, problem in enumerate(problems):
            self._bind(lane, problem)
        lanes = self.work.reshape(-1, LANES)
        for lane in range(len(problems), LANES):  # idle lanes repeat the first, harmlessly
            lanes[:, lane], self.settings[:, lane] = lanes[:, 0], self.settings[:, 0]
            self.counters[Counter.STATUS, lane] = Status.IDLE
        self._start()

    def table(self, name: str, count: int = 1) -> Floats:
        """Return a view (count, LANES) of a block of the work array."""
        first = self.kernel.layout[name]
        return self.work.reshape(-1, LANES)[first : first + count]

    def advance(self, budget: int) -> int:
        """Attempt at most `budget` steps; how many lanes still run. Rows are handed out once."""
        self.counters[Counter.SAMPLE_ROWS :] = 0
        return int(
            advance(
                *self.kernel.functions,
                self.kernel.slots,
                self.kernel.held,
                self.work,
                self.spare,
                self.store,
                self.settings,
                self.counters,
                self.scratch,
                self.sample_rows,
                self.section_rows,
                self.impact_rows,
                budget,
            )
        )

    def observe(self, lane: int, rows: Floats, columns: NDArray[np.int64]) -> Floats:
        """Return channels (rows, columns) of a lane at rows of dense state."""
        module = self.kernel.module
        out = np.empty((len(rows), len(columns)))
        observe_rows(
            module.right_hand_side,
            module.observe,
            module.observe_rest,
            self.kernel.slots,
            self.work,
            self.spare,
            lane,
            rows,
            columns,
            out,
        )
        return out

    def time(self, lane: int) -> float:
        """Return the simulated time that a lane has reached, s."""
        whole = int(self.counters[Counter.PERIOD, lane])
        local = float(self.table("time")[0, lane])
        return whole * float(self.settings[Setting.PERIOD, lane]) + local

    def state(self) -> bytes:
        """Return everything that the next step depends on."""
        buffer = io.BytesIO()
        np.savez(buffer, work=self.work, settings=self.settings, counters=self.counters)
        return buffer.getvalue()

    def restore(self, state: bytes) -> None:
        """Continue from `state`, bit for bit."""
        with np.load(io.BytesIO(state), allow_pickle=False) as saved:
            self.work[:] = saved["work"]
            self.settings[:] = saved["settings"]
            self.counters[:] = saved["counters"]

    def _bind(self, lane: int, problem: LaneProblem) -> None:
        """Set a lane's numbers, scales and start."""
        kernel, scene, work = self.kernel, problem.scene, self.work.reshape(-1, LANES)
        for (slot, _), value in zip(kernel.fixed, kernel.fixed_values(scene), strict=True):
            work[slot, lane] = value
        length = shortest_link(scene)
        unit = characteristic_time(scene, length)
        common = common_period(scene).seconds
        period = common or unit
        self._clock(lane, problem, period, common is not None)
        assembly = assemble(scene)
        position, speed = start_state(scene, kernel.coordinates, assembly.pose, assembly.velocity)
        count = len(kernel.coordinates)
        self.table("y0", 2 * count)[:, lane] = [*position, *speed]
        clearances = [scene.joints[name].clearance for name in kernel.play]  # type: ignore[union-attr]
        finest = min((c.radial_clearance for c in clearances if c), default=math.inf)
        reach = mechanism_size(scene, length)
        for i, name in enumerate(kernel.coordinates):
            angle = name.endswith(".theta")
            scale = 1.0 if angle else length
            close = min(scale, finest / reach if angle else finest)
            self.table(f"weight{i}")[0, lane] = 1.0 / (problem.tolerance * close)
            self.table(f"weight{count + i}")[0, lane] = unit / (
                problem.tolerance * scale * 2.0 * math.pi
            )
        for j, clearance in enumerate(clearances):
            assert clearance is not None  # noqa: S101  (joints with play have one; narrows the type)
            self.table(f"impact_floor{j}")[0, lane] = clearance.contact.impact_rate_floor
            self.table(f"restart{j}")[0, lane] = RESTART * clearance.radial_clearance

    def _clock(self, lane: int, problem: LaneProblem, period: float, common: bool) -> None:
        scene = problem.scene
        self.table("step")[0, lane] = FIRST_STEP * period
        self.table("largest_step")[0, lane] = period / STEPS_IN_A_PERIOD
        self.table("smallest_step")[0, lane] = period
        self.table("end")[0, lane] = problem.duration
        setting = self.settings[:, lane]
        setting[Setting.PERIOD] = period
        setting[Setting.COMMON] = 1.0 if common else 0.0
        turning = all(isinstance(scene.joints[d.joint], Revolute) for d in scene.drivers.values())
        setting[Setting.TURNING] = 1.0 if turning else 0.0
        setting[Setting.DURATION] = problem.duration
        setting[Setting.OUTPUT_STEP] = problem.output_step
        setting[Setting.SECTION_OFFSET] = problem.section_offset
        setting[Setting.SMALLEST_STEP] = SMALLEST_STEP * period
        for k, driver in enumerate(scene.drivers.values()):
            self.table(f"phase{k}")[0, lane] = driver.position
            travel = driver.speed * period / (2.0 * math.pi if turning else 1.0)
            setting[Setting.FIRST_DRIVER + 2 * k] = driver.position
            setting[Setting.FIRST_DRIVER + 2 * k + 1] = round(travel) if common else travel
        counter = self.counters[:, lane]
        counter[Counter.SAMPLES], counter[Counter.SECTIONS] = problem.samples, problem.sections

    def _start(self) -> None:
        """Evaluate the start: first slopes, contacts that begin closed, first records."""
        kernel, module = self.kernel, self.kernel.module
        states, joints, rows = kernel.states, len(kernel.play), kernel.rows.scanned
        self.table("stage0", states)[:] = self.table("y0", states)
        for j in range(joints):
            self.table(f"impact_rate{j}")[:] = self.table(f"impact_floor{j}")
        module.right_hand_side(self.work)
        for j in range(joints):
            gap, rate = self.table(f"gap{j}")[0], self.table(f"gap_rate{j}")[0]
            self.table(f"mode{j}")[0] = np.where(gap > 0.0, 1.0, 0.0)
            floor = self.table(f"impact_floor{j}")[0]
            self.table(f"impact_rate{j}")[0] = np.maximum(rate, floor)
            self.table(f"approach{j}")[0] = rate
        module.right_hand_side(self.work)
        self.table("k1_0", states)[:] = self.table("slope0", states)
        ledger = LEDGER + joints
        self.table("kledger1_0", ledger)[:] = self.table("ledger0", ledger)
        for j in range(joints):
            self.table(f"gap_start{j}")[:] = self.table(f"gap{j}")
            self.table(f"gap_rate_start{j}")[:] = self.table(f"gap_rate{j}")
        module.observe(self.work)
        module.observe_rest(self.work)
        for block in ("previous0", "highest0", "lowest0"):
            self.table(block, rows)[:] = self.table("channel0", rows)
        self.table("change0", rows)[:] = math.nan
        if joints:
            episodes = self.table("lowest0", rows)[rows - joints :]
            episodes[:] = -math.inf
        self.table("active")[0] = self.counters[Counter.STATUS] == Status.RUNNING
        for lane in range(len(self.problems)):
            plan(lane, kernel.slots, self.work, self.settings, self.counters)


def aligned_zeros(size: int) -> Floats:
    """Return zeros that begin on a cache line: else every row of eight lanes straddles two."""
    line = 64
    padded = np.zeros(size + line // 8)
    skip = (-padded.ctypes.data % line) // 8
    return padded[skip : skip + size]
