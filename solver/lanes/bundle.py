"""A bundle: up to eight runs of one kernel, their state, and the rows that they hand out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.compensated import product_difference
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.entry_point import PreparedCall
from jointplay.solver.kernels.layout import BUNDLE, INSTANTS
from jointplay.solver.kernels.loop.entry_points import advance, observe_rows, plan_anew
from jointplay.solver.kernels.loop.extremes.search.brackets import room_for
from jointplay.solver.kernels.loop.runs import DTYPE, NO_PAIR, RUNNING, SECTIONS, Buffers, Status
from jointplay.solver.kernels.loop.workspace import Workspace
from jointplay.solver.lanes.binding import FIRST_STEP, number
from jointplay.solver.lanes.lane import Lane, aligned_zeros
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.lanes.ready_lanes import ENERGIES, ReadyLanes, make_ready
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.time_scales import driven_speed

LaneState = tuple[Floats, Any, Floats]
"""A lane's numbers (slots,), its run, and its first energies (3,), J."""

HANDED_OUT = ("filled", "impacts", "growths", "kept")
"""Fields of a run that say how much of the buffers it has filled."""
ROWS_AT_ONCE = 2048
"""Capacity of each row buffer: how many samples a lane hands out between returns to Python."""
STEPS_AT_ONCE = 32_768
"""The same of accepted steps, of all lanes that keep them: some 50 ms of computing."""


@dataclass
class GroupState:
    """State of the lanes that a kernel advances at once, of which `workspace` makes a group."""

    work: Floats
    """(slots, lanes)."""
    runs: NDArray[np.void]
    """(lanes,)."""
    buffers: Buffers
    attempts: int = 0
    """Attempts at a step that were made, each of all lanes at once."""
    advancing: PreparedCall | None = None
    """Advances them: to lay out its arguments anew for each call would take longer."""

    @property
    def runs_on(self) -> bool:
        """Whether a lane runs."""
        return bool((self.runs["status"] == RUNNING).any())


class Bundle:
    """Runs up to eight problems of one structure side by side; lanes do not touch each other."""

    def __init__(
        self,
        kernel: Kernel,
        problems: Sequence[LaneProblem] = (),
        *,
        watch: bool = True,
        tangents: Tangents | None = None,
        keep_steps: int = 0,
    ) -> None:
        """Load the problems.

        `watch` says whether extremes of channels are sought. With the kernel's `tangents` every
        lane carries a tangent vector, and `growth` tells how it grows; nothing else changes.
        Of the first `keep_steps` lanes, accepted steps are handed out; see `steps`.
        """
        if len(problems) > BUNDLE:
            raise ValueError(f"a bundle holds {BUNDLE} problems, not {len(problems)}")
        self.kernel = kernel
        self.watch = watch
        self.tangents = tangents
        size = (tangents or kernel).layout.size
        self.width = width = kernel.lanes
        self.spare = aligned_zeros(kernel.layout.size, INSTANTS)
        self.brackets = room_for(kernel.rows.scanned)
        self.runs = np.zeros(BUNDLE, DTYPE)
        self.runs["status"] = Status.IDLE
        self.runs["landing"] = NO_PAIR
        self.first_energy = np.zeros((len(ENERGIES), BUNDLE))
        self.groups = [
            GroupState(
                aligned_zeros(size, width),
                self.runs[first : first + width],
                Buffers.of(
                    width,
                    ROWS_AT_ONCE,
                    kernel.row.width,
                    tangents=tangents is not None,
                    steps=(
                        min(max(keep_steps - first, 0), width),
                        STEPS_AT_ONCE // max(keep_steps, 1),
                        kernel.step_row.width,
                    ),
                ),
            )
            for first in range(0, BUNDLE, width)
        ]
        for i, problem in enumerate(problems):
            self.load(i, problem)

    def lane(self, i: int) -> Lane:
        """Return the lane of a run."""
        group, index = divmod(i, self.width)
        return Lane(self.kernel, self.tangents, self.groups[group].work, index, self.runs[i])

    def block(self, name: str) -> Floats:
        """Return a copy of a block of all lanes, (slots, lanes)."""
        return np.stack([self.lane(i)[name] for i in range(len(self.runs))], axis=1)

    def load(self, i: int, problem: LaneProblem, like: int | None = None) -> None:
        """Give a lane that does not run a problem to compute; the other lanes do not notice.

        `like` is a lane that has the problem's scene already, which saves looking at it again.
        """
        self.load_together({i: problem}, like)

    def load_together(self, problems: Mapping[int, LaneProblem], like: int | None = None) -> None:
        """Give lanes problems that may be made ready together (`make_ready`); as `load`."""
        numbers = None if like is None else self.lane(like).column
        given = list(problems.values())
        if not given:
            return
        ready = make_ready(
            self.kernel, self.tangents, given, lambda k: given[k].scene, like=numbers
        )
        for k, i in enumerate(problems):
            self.load_ready(i, ready, k)

    def load_ready(self, i: int, ready: ReadyLanes, k: int) -> None:
        """Give a lane that does not run the k-th of problems that were made ready; as `load`."""
        self.take_up(i, ready.work[k], ready.runs[k], ready.first_energy[k])

    def take_up(self, i: int, column: Floats, run: Any, first_energy: Floats) -> None:
        """Give a lane that does not run the state of another, wherever that was, bit for bit.

        column : (slots,). run : of type `Run`. first_energy : (3,) J.
        """
        group, index = self.groups[i // self.width], i % self.width
        group.work[:, index] = column
        self.runs[i] = run
        self.first_energy[:, i] = first_energy
        idle = group.runs["status"] == Status.IDLE
        if idle.any():  # their numbers are harmless, unlike zeros
            group.work[:, idle] = group.work[:, [index]]
            group.work[self.kernel.layout["active"], idle] = 0.0

    def number_like(self, other: Bundle, i: int, scene: Scene) -> None:
        """Give the first lane the numbers of a scene that a lane of another bundle has already."""
        size, first = self.kernel.layout.size, self.lane(0)
        first.column[:size] = other.lane(i).column[:size]
        if self.tangents is not None:
            number(first, self.tangents, scene)

    def extend(
        self, i: int, scene: Scene, duration: float, sections: int, *, forget: bool = False
    ) -> None:
        """Let a lane that is done go on to a later end; `forget` its extremes so far.

        Parameters
        ----------
        scene
            That the lane runs: checkpoints do not hold it.
        duration
            From the lane's start, s.
        sections
            As in `LaneProblem`.
        """
        lane = self.lane(i)
        whole, period = float(lane.run["periods"]), lane.run["period"]
        lane.run["duration"] = duration
        lane["driven_speed"] = driven_speed(scene, lane.number("lever"), duration)
        lane["end"] = product_difference(duration, 1.0, whole, period)
        lane.run["stop"][SECTIONS] = sections
        if forget:
            for kind in ("highest", "lowest"):
                lane[kind], lane[f"{kind}_time"] = lane["previous"], lane.time
            lane["change"] = math.nan
            # no change is known before the next step: a long one could hide an extreme
            lane["step"] = FIRST_STEP * lane.run["unit"]
        self.set_going(i)

    def set_going(self, i: int) -> None:
        """Let a lane run from where it is to the end that its run has."""
        lane = self.lane(i)
        lane.run["status"] = Status.RUNNING
        lane["active"] = 1.0
        self.plan_anew(i)
        lane["next_due"] = -math.inf  # the first step is looked at, whatever is due in it
        self.touched(i)

    def touched(self, i: int) -> None:
        """Note that a lane's numbers here are the newest ones; a bundle here has no others."""

    def plan_anew(self, i: int) -> None:
        """Let a lane go by what its run says of samples, sections and its end from now on."""
        lane = self.lane(i)
        plan_anew(lane.slots, lane.work, self.runs[i : i + 1], lane.index)

    def stop(self, i: int) -> None:
        """Let a lane run no more: it is free, and what it had come to is lost."""
        self.lane(i).end(Status.IDLE)
        self.touched(i)

    @property
    def attempts(self) -> int:
        """Attempts at a step that were made of each lane that runs, or of all that have run."""
        made = [group.attempts for group in self.groups if group.runs_on]
        return min(made, default=max(group.attempts for group in self.groups))

    @attempts.setter
    def attempts(self, made: int) -> None:
        for group in self.groups:
            group.attempts = made

    @property
    def behind(self) -> int:
        """Attempts by which some running lanes are behind others that run."""
        made = [group.attempts for group in self.groups if group.runs_on]
        return max(made) - min(made) if made else 0

    def advance(self, budget: int) -> int:
        """Attempt at most `budget` steps.

        Returns how many lanes still run. Rows are handed out once.

        Comes back early when a lane ends or has as many rows as it can hold.
        """
        for name in HANDED_OUT:
            self.runs[name] = 0
        running = [group for group in self.groups if group.runs_on]
        goal = min((group.attempts for group in running), default=0) + budget
        for group in running:
            if group.advancing is None:
                group.advancing = advance.prepare(self.workspace(group), group.buffers, 0, 0)
            group.attempts += group.advancing(int(self.watch), goal - group.attempts)
        return int(np.count_nonzero(self.runs["status"] == RUNNING))

    def workspace(self, group: GroupState) -> Workspace:
        """Return a group of lanes as kernels take it."""
        of = self.tangents or self.kernel
        arrays = group.work, self.spare, group.runs, self.brackets
        return Workspace(of.addresses, of.slots, *arrays)

    def rows(self, kind: int, i: int) -> Floats:
        """Return what a lane handed out in the last call: dense rows (count, width).

        kind : `SAMPLES` or `SECTIONS`.
        """
        group, index = divmod(i, self.width)
        return self.groups[group].buffers.rows[kind, index, : self.runs["filled"][i, kind]]

    def impacts(self, i: int) -> NDArray[np.void]:
        """Return the contacts of a lane that ended in the last call, of dtype `IMPACT`."""
        group, index = divmod(i, self.width)
        return self.groups[group].buffers.impacts[index, : self.runs["impacts"][i]].copy()

    def steps(self, i: int) -> Floats:
        """Return accepted steps of a lane in the last call, (count, width); see `StepRow`."""
        group, index = divmod(i, self.width)
        return self.groups[group].buffers.steps[index, : self.runs["kept"][i]]

    def growth(self, i: int) -> Floats:
        """Return how a lane's tangent grew in the last call: (k, 2) ends of time, s, logarithms."""
        group, index = divmod(i, self.width)
        growths = self.groups[group].buffers.growths[index, : self.runs["growths"][i]]
        return growths.copy().view(np.float64).reshape(-1, 2)

    def observe(self, i: int, rows: Floats, columns: NDArray[np.int64]) -> Floats:
        """Return channels (rows, columns) of a lane at rows of dense state."""
        lane, kernel = self.lane(i), self.kernel
        out = np.empty((len(rows), len(columns)))
        blank = self.spare.reshape(-1)[: kernel.layout.size * self.width].reshape(-1, self.width)
        observe_rows(
            kernel.addresses, kernel.slots, lane.work, blank, lane.index, rows, columns, out
        )
        return out

    def times(self, i: int, rows: Floats) -> Floats:
        """Return the simulated times of a lane's dense rows, s."""
        return self.kernel.row.times(rows, float(self.runs["period"][i]))

    def now(self) -> Floats:
        """Return the simulated times that lanes have reached, (lanes,), s."""
        slot = self.kernel.layout["time"]
        local = np.concatenate([group.work[slot] for group in self.groups])
        return np.asarray(self.runs["periods"] * self.runs["period"] + local)

    def state_of(self, i: int) -> LaneStart:
        """Return where a lane is, for another problem to start from."""
        lane = self.lane(i)
        return LaneStart(lane["y"].copy(), lane["mode"] > 0.0, lane["impact_rate"].copy())

    def states_of(self, lanes: Sequence[int]) -> list[LaneState]:
        """Return everything that the next step of some lanes depends on, for `take_up`."""
        return [
            (self.lane(i).column.copy(), self.runs[i].copy(), self.first_energy[:, i].copy())
            for i in lanes
        ]

    def energy(self, i: int) -> Floats:
        """Return a lane's kinetic, potential and stored elastic energy, J."""
        columns = np.array([self.kernel.rows.index(name) for name in ENERGIES], dtype=np.int64)
        (energies,) = self.observe(i, self.lane(i).row(), columns)
        return np.asarray(energies, np.float64)

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return everything that the next step depends on, however many lanes there are.

        Arrays of a checkpoint, whose names begin with `name`.
        """
        work = np.concatenate([group.work for group in self.groups], axis=1)
        saved = {"work": work, "runs": self.runs, "first_energy": self.first_energy}
        return {f"{name}/{part}": array for part, array in saved.items()}

    def release(self) -> None:
        """Give back what lanes have elsewhere; here they have nothing but memory."""

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        self.runs[:] = saved[f"{name}/runs"]
        self.first_energy[:] = saved[f"{name}/first_energy"]
        works = np.split(saved[f"{name}/work"], len(self.groups), axis=1)
        for group, work in zip(self.groups, works, strict=True):
            group.work[:] = work
