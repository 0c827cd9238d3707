"""A bundle: up to eight runs of one kernel, their state, and the rows that they hand out."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.assembly import assemble, shortest_link
from solver.compiler.kernel import LEDGER, CompiledAddress, Kernel
from solver.compiler.layout import LANES
from solver.compiler.tangents import Tangents
from solver.drive import characteristic_time, common_period
from solver.lanes.advance import advance
from solver.lanes.clock import product_difference
from solver.lanes.observation import observe_rows
from solver.lanes.peaks import POINTS
from solver.lanes.periods import PACE_STEPS, look_ahead, plan
from solver.lanes.start import mechanism_size, start_state
from solver.lanes.state import Counter, SectionKind, Setting, Status, row_width
from solver.lanes.tangent import start_tangent
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
ENERGIES = ("energy.kinetic", "energy.potential", "stored")
STATE = ("work", "settings", "counters", "first_energy")
"""Arrays of a bundle that the next step, or what is said of the run, depends on."""


@dataclass(frozen=True)
class Event:
    """A Poincare section that no clock gives: an onset at a joint, or a channel at a value."""

    kind: SectionKind
    place: int
    """Index of the joint with play, or row of the channel block."""
    value: float = 0.0
    sense: float = 1.0
    """1: the channel comes from below; -1: from above."""
    not_before: float = 0.0
    """Time from which events count, s."""


@dataclass(frozen=True)
class LaneStart:
    """Where a lane starts instead of at the scene's own start."""

    state: Floats
    """Coordinates, then speeds."""
    contact: NDArray[np.bool_] | None = None
    """Joints that are in contact already, with their latched impact rates (m/s)."""
    impact_rate: Floats | None = None


@dataclass(frozen=True)
class LaneProblem:
    """What one lane is to compute."""

    scene: Scene
    duration: float
    tolerance: float
    output_step: float
    samples: int
    sections: int
    """Number of the section that follows the last one wanted; of events, how many."""
    section_offset: float
    first_section: int = 0
    event: Event | None = None
    start: LaneStart | None = None


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
        self.first_energy = np.zeros((len(ENERGIES), LANES))
        width = row_width(drivers, kernel.states, joints)
        self.sample_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.section_rows = np.zeros((LANES, ROWS_AT_ONCE, width))
        self.impact_rows = np.zeros((LANES, ROWS_AT_ONCE, 6))
        self.growth_rows = np.zeros((LANES, 0 if tangents is None else ROWS_AT_ONCE, 2))
        self.scratch = np.zeros((kernel.rows.scanned + 1, POINTS + 1))
        for lane, problem in enumerate(problems):
            self.load(lane, problem)

    def load(self, lane: int, problem: LaneProblem) -> None:
        """Give a lane that does not run a problem to compute; the other lanes do not notice.

        Lanes that never had one repeat this one's numbers: harmless, unlike zeros.
        """
        self._bind(lane, problem)
        fresh = self.counters[Counter.STATUS] == Status.IDLE
        fresh[lane] = False
        self.work.reshape(-1, LANES)[:, fresh] = self.work.reshape(-1, LANES)[:, [lane]]
        self.table("active")[0, fresh] = 0.0
        self._start(lane, problem.start)

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
                self.scratch,
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

    def _bind(self, lane: int, problem: LaneProblem) -> None:
        """Set a lane's numbers, scales and start."""
        kernel, scene, work = self.kernel, problem.scene, self.work.reshape(-1, LANES)
        for (slot, _), value in zip(kernel.fixed, kernel.fixed_values(scene), strict=True):
            work[slot, lane] = value
        if self.tangents is not None:
            values = self.tangents.fixed_values(scene)
            for (slot, _), value in zip(self.tangents.fixed, values, strict=True):
                work[slot, lane] = value
        length = shortest_link(scene)
        unit = characteristic_time(scene, length)
        common = common_period(scene).seconds
        period = common or unit
        self._clock(lane, problem, period, common is not None)
        if problem.start is None:
            assembly = assemble(scene)
            start = start_state(scene, kernel.coordinates, assembly.pose, assembly.velocity)
            state = np.concatenate(start)
        else:
            state = problem.start.state
        count = len(kernel.coordinates)
        self.table("y0", 2 * count)[:, lane] = state
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
        for name in (
            "time",
            "stage_time",
            "memory",
            "steps",
            "tried",
            "before_step",
            "before_time",
        ):
            self.table(name)[0, lane] = 0.0
        self.table("pace_at")[0, lane] = PACE_STEPS
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
            self.table(f"wound{k}")[0, lane] = 0.0
            travel = driver.speed * period / (2.0 * math.pi if turning else 1.0)
            setting[Setting.FIRST_DRIVER + 2 * k] = driver.position
            setting[Setting.FIRST_DRIVER + 2 * k + 1] = round(travel) if common else travel
        event = problem.event or Event(SectionKind.CRANK, 0)
        setting[Setting.SECTION_KIND], setting[Setting.SECTION_PLACE] = event.kind, event.place
        setting[Setting.SECTION_VALUE], setting[Setting.SECTION_SENSE] = event.value, event.sense
        setting[Setting.SECTION_FROM] = event.not_before
        setting[Setting.PACE_TIME] = 0.0
        counter = self.counters[:, lane]
        counter[:] = 0
        counter[Counter.LANDING] = -1
        counter[Counter.SAMPLES], counter[Counter.SECTIONS] = problem.samples, problem.sections
        counter[Counter.SECTION] = problem.first_section

    def _start(self, lane: int, start: LaneStart | None) -> None:
        """Evaluate a lane's start: first slopes, contacts that begin closed, first records."""
        kernel, module = self.kernel, self.kernel.module
        joints, rows = len(kernel.play), kernel.rows.scanned
        lanes = self.work.reshape(-1, LANES)[:, lane]
        at = kernel.layout

        def block(name: str, count: int) -> Floats:
            return lanes[at[name] : at[name] + count]

        block("stage0", kernel.states)[:] = block("y0", kernel.states)
        floor = block("impact_floor0", joints) if joints else np.zeros(0)
        for j in range(joints):
            lanes[at[f"mode{j}"]], lanes[at[f"impact_rate{j}"]] = 0.0, floor[j]
        module.right_hand_side(self.work)
        for j in range(joints):
            rate = lanes[at[f"gap_rate{j}"]]
            closed = lanes[at[f"gap{j}"]] > 0.0
            latched = max(rate, floor[j])
            if start is not None and start.contact is not None and start.contact[j]:
                latched = max(start.impact_rate[j], floor[j])  # type: ignore[index]
            lanes[at[f"mode{j}"]] = 1.0 if closed else 0.0
            lanes[at[f"impact_rate{j}"]] = latched
            lanes[at[f"approach{j}"]] = rate
            lanes[at[f"onset_time{j}"]] = lanes[at[f"onset_total{j}"]] = 0.0
        module.right_hand_side(self.work)
        ledger = LEDGER + joints
        block("k1_0", kernel.states)[:] = block("slope0", kernel.states)
        block("kledger1_0", ledger)[:] = block("ledger0", ledger)
        block("total0", ledger)[:] = 0.0
        for j in range(joints):
            lanes[at[f"gap_start{j}"]] = lanes[at[f"gap{j}"]]
            lanes[at[f"gap_rate_start{j}"]] = lanes[at[f"gap_rate{j}"]]
        module.observe(self.work)
        for name in ("previous0", "highest0", "lowest0"):
            block(name, rows)[:] = block("channel0", rows)
        for name in ("highest_time0", "lowest_time0"):
            block(name, rows)[:] = 0.0
        block("change0", rows)[:] = math.nan
        if joints:
            block("lowest0", rows)[rows - joints :] = -math.inf
        if self.tangents is not None:
            self._start_tangent(lane)
        self._run(lane)
        self.first_energy[:, lane] = self.energy(lane)

    def _start_tangent(self, lane: int) -> None:
        """Give a lane its first tangent; its state is in the stage still."""
        assert self.tangents is not None  # noqa: S101  (asked before)
        start_tangent(lane, self.slots, self.work)
        if self.tangents.kinks:
            self.tangents.module.kinks(self.work)
            rows = 3 * self.tangents.kinks
            self.table("kink_start0", rows)[:, lane] = self.table("kink_end0", rows)[:, lane]


def aligned_zeros(size: int) -> Floats:
    """Return zeros that begin on a cache line: else every row of eight lanes straddles two."""
    line = 64
    padded = np.zeros(size + line // 8)
    skip = (-padded.ctypes.data % line) // 8
    return padded[skip : skip + size]
