"""Runs a block of a study: its points in eight lanes, a lane refilled as soon as it is free.

What a point hands out depends on the study alone: lanes do not touch each other, and nothing here
looks at the clock but the length of slices. Points of another structure need another kernel; they
wait until the lanes of this one are done.
"""

from __future__ import annotations

import io
import json
import time
from collections.abc import Iterator
from dataclasses import asdict, astuple
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.failure import SimulationFailed
from jointplay.records.point import PointEnd, SectionRows, StudySlice
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents, compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.failures import contacts_of, failure_of, peaks_of, statistics_of
from jointplay.solver.kernels.loop.problem import LaneStart
from jointplay.solver.kernels.loop.state import Counter, Status
from jointplay.solver.runs.simulate import FIRST_BUDGET, LARGEST_BUDGET, SLICE_SECONDS
from jointplay.solver.runs.study.indicators import MOST_SECTIONS, growth_by_period, indicators_of
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import (
    ENDLESS,
    WINDOW,
    PointRun,
    most_settling,
    problem_of,
    scales_of,
)
from jointplay.solver.runs.study.window import statistics_in, take_contacts, take_samples

Floats = NDArray[np.float64]

SERIES = ("seen", "growth", "tallies")
"""Of a point's run: lists of arrays that a restart point needs."""


class StudyRun:
    """One block: `slices` computes it, `checkpoint` between slices restarts it bit for bit."""

    def __init__(self, study: Study, block: int, checkpoint: bytes | None = None) -> None:
        """Queue the block's chains of points, or take up where the checkpoint was made.

        Parameters
        ----------
        block
            Index into `study.blocks`.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        self.study = study
        self.first, self.count = study.blocks[block]
        self.waiting: list[PointRun] = []
        """Points that may begin, in the order of their chains."""
        self.lanes: list[PointRun | None] = [None] * LANES
        self.ended = 0
        self.structure = -1
        self.bundle: Bundle | None = None
        self.columns = self.sampled = np.zeros(0, dtype=np.int64)
        """Rows of the observables, and of the channels, in the kernel's block of channels."""
        if checkpoint is not None:
            self._restore(checkpoint)
            return
        points = range(self.first, self.first + self.count)
        for chain in sorted({int(study.chain_of[point]) for point in points}):
            self.waiting.append(PointRun(study.chain_order[chain][0], chain, 0))

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every point of the block has ended."""
        budget = FIRST_BUDGET
        while self.waiting or any(self.lanes):
            started = self._fill()
            assert self.bundle is not None  # noqa: S101  (filling made it)
            begun = time.perf_counter()
            before = self.bundle.attempts
            self.bundle.advance(budget)
            rows, ended = self._collect()
            spent = time.perf_counter() - begun
            made = max(self.bundle.attempts - before, 1)
            budget = int(min(max(made * SLICE_SECONDS / spent, 100), LARGEST_BUDGET, 4 * budget))
            yield StudySlice(self._fraction(), started, tuple(rows), tuple(ended))

    def _fill(self) -> tuple[int, ...]:
        """Give every free lane a point of the present structure; another one once all are free."""
        if self.bundle is None or not any(self.lanes):
            structures = self.study.structure[[run.point for run in self.waiting]]
            if self.structure not in structures or self.bundle is None:
                self._switch(int(structures.min()))
        assert self.bundle is not None  # noqa: S101  (switching made it)
        started = []
        for lane in range(LANES):
            if self.lanes[lane] is not None:
                continue
            fitting = (
                run for run in self.waiting if self.study.structure[run.point] == self.structure
            )
            run = next(fitting, None)
            if run is None:
                break
            self.waiting.remove(run)
            self.lanes[lane] = run
            self.bundle.load(lane, problem_of(self.study, self.bundle.kernel, run))
            started.append(run.point)
        return tuple(started)

    def _switch(self, structure: int) -> None:
        """Prepare lanes for points of another structure."""
        study = self.study
        kernel, tangents = kernel_of(study, structure)
        self.structure = structure
        self.bundle = Bundle(kernel, watch=bool(study.channels), tangents=tangents)
        self.columns, self.sampled = (
            np.array([kernel.rows.index(channel.name) for channel in chosen], dtype=np.int64)
            for chosen in (study.observables, study.channels)
        )

    def _collect(self) -> tuple[list[SectionRows], list[PointEnd]]:
        """Take the rows of all lanes and end the points that are over."""
        assert self.bundle is not None  # noqa: S101  (it has just advanced)
        handed_out: list[SectionRows] = []
        ended: list[PointEnd] = []
        for lane, run in enumerate(self.lanes):
            if run is None:
                continue
            if run.settled >= 0:
                run.growth.append(self.bundle.growth(lane).copy())
            handed_out += self._rows(lane, run)
            if run.tallies:
                self._tally(lane, run)
            status = Status(self.bundle.counters[Counter.STATUS, lane])
            if status == Status.DONE and self._goes_on(lane, run):
                continue
            if status != Status.RUNNING:
                ended.append(self._end(lane, run, status))
                self.lanes[lane] = None
                self.ended += 1
        return handed_out, ended

    def _rows(self, lane: int, run: PointRun) -> list[SectionRows]:
        """Return a lane's new sections, if they are to be recorded."""
        bundle = self.bundle
        assert bundle is not None  # noqa: S101  (it has just advanced)
        rows = bundle.section_rows[lane, : bundle.counters[Counter.SECTION_ROWS, lane]]
        if not len(rows):
            return []
        times = rows[:, 0] * float(self.study.period[run.point]) + rows[:, 1]
        if run.settled < 0 or (self.study.indicators and run.taken < MOST_SECTIONS):
            first_state = 2 + 2 * len(bundle.kernel.drivers)
            run.seen.append(rows[:, first_state : first_state + bundle.kernel.states].copy())
        if run.settled < 0:
            return []
        values = bundle.observe(lane, rows, self.columns)
        first = run.taken
        run.taken += len(rows)
        return [SectionRows(run.point, first, times, values)]

    def _tally(self, lane: int, run: PointRun) -> None:
        """Take a lane's new samples, and the contacts that ended after settling."""
        bundle, study = self.bundle, self.study
        assert bundle is not None  # noqa: S101  (it has just advanced)
        rows = bundle.sample_rows[lane, : bundle.counters[Counter.SAMPLE_ROWS, lane]]
        if len(rows):
            take_samples(study, run, bundle.observe(lane, rows, self.sampled))
        if run.settled >= 0 and bundle.counters[Counter.IMPACT_ROWS, lane]:
            take_contacts(study, run, contacts_of(bundle, lane))

    def _goes_on(self, lane: int, run: PointRun) -> bool:
        """Whether a lane at the end of a leg was given the next one."""
        if run.settled >= 0:
            return False
        study, point, bundle = self.study, run.point, self.bundle
        assert bundle is not None  # noqa: S101  (it has just advanced)
        if study.record == 0:
            run.settled = 0
            bundle.extend(lane, float(study.duration[point]), 0, forget=True)
            return True
        period = float(study.period[point])
        most = most_settling(study, point)
        scales, angles = scales_of(study, bundle.kernel, point)
        if run.reached < most and not run.has_settled(scales, angles, most):
            run.reached = min(run.reached + WINDOW, most)
            bundle.extend(lane, run.reached * period, ENDLESS)
            return True
        run.settled = run.reached
        run.seen = []
        left = float(study.duration[point] - study.settle[point])
        taken = int(bundle.counters[Counter.SECTION, lane])
        bundle.extend(lane, run.settled * period + left, taken + study.record)
        return True

    def _end(self, lane: int, run: PointRun, status: Status) -> PointEnd:
        """Close a point, and let the next one of its chain wait for a lane."""
        bundle, study = self.bundle, self.study
        assert bundle is not None  # noqa: S101  (it has just advanced)
        failure: SimulationFailed | None = None
        if status != Status.DONE:
            failure = failure_of(bundle, lane, study.tolerance)
        names = [channel.name for channel in study.channels]
        peaks = peaks_of(bundle, lane, names).values()
        end = PointEnd(
            run.point,
            failure.code if failure else "",
            failure.detail if failure else "",
            bundle.time(lane),
            np.array([astuple(peak) for peak in peaks]).reshape(-1, 4),
            self._statistics(lane, run, whole=failure is None),
            {} if failure or not study.indicators else self._indicators(run),
        )
        order = study.chain_order[run.chain]
        if run.position + 1 < len(order):
            start = None if failure else bundle.state_of(lane)
            following = run.position + 1
            self.waiting.append(PointRun(order[following], run.chain, following, start))
        return end

    def _indicators(self, run: PointRun) -> dict[str, float]:
        assert self.bundle is not None  # noqa: S101  (it has just advanced)
        kernel, study = self.bundle.kernel, self.study
        states = np.concatenate(run.seen) if run.seen else np.zeros((0, kernel.states))
        scales, angles = scales_of(study, kernel, run.point)
        period = float(study.period[run.point])
        growth = np.concatenate([np.zeros((0, 2)), *run.growth])
        by_period = growth_by_period(growth, period, run.settled)
        return indicators_of(study.indicators, states, scales, angles, by_period, period)

    def _statistics(self, lane: int, run: PointRun, *, whole: bool) -> dict[str, float]:
        """Return what every point has; those of channels and contacts too if it ran to its end."""
        assert self.bundle is not None  # noqa: S101  (it has just advanced)
        found: dict[str, Any] = statistics_of(self.bundle, lane)
        energy = found.pop("energy")
        found["smallest_step"] = found["smallest_step"] or float("nan")
        chosen = ("driver_work", "contact_loss", "friction_loss", "gross_work", "residual")
        found |= {f"energy_{name}" if name == "residual" else name: energy[name] for name in chosen}
        found |= {
            "settled_periods": max(run.settled, 0) if self.study.record else float("nan"),
            "settling": run.settling.result.code if run.settling and run.settling.result else 0,
            "from_neighbour": float(run.start is not None),
        }
        if run.tallies and whole:
            found |= statistics_in(self.study, run, self.bundle.kernel.play)
        return {name: float(value) for name, value in found.items()}

    def _fraction(self) -> float:
        """Return how much of the block is computed, 0..1."""
        assert self.bundle is not None  # noqa: S101  (it has just advanced)
        under_way = sum(
            min(self.bundle.time(lane) / float(self.study.duration[run.point]), 1.0)
            for lane, run in enumerate(self.lanes)
            if run is not None
        )
        return min((self.ended + under_way) / self.count, 1.0)

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        runs = [*self.waiting, *(run for run in self.lanes if run is not None)]
        arrays: dict[str, NDArray[Any]] = {}
        for run in runs:
            for name in SERIES:
                parts = getattr(run, name)
                arrays |= {f"{name}{run.point}-{i}": part for i, part in enumerate(parts)}
            if run.start is not None:
                arrays |= {
                    f"start{run.point}-{name}": value
                    for name, value in asdict(run.start).items()
                    if value is not None
                }
        facts = {
            "structure": self.structure,
            "ended": self.ended,
            "waiting": [_facts(run) for run in self.waiting],
            "lanes": [None if run is None else _facts(run) for run in self.lanes],
        }
        if self.bundle is not None:
            arrays["bundle"] = np.frombuffer(self.bundle.state(), dtype=np.uint8)
        arrays["facts"] = np.frombuffer(json.dumps(facts).encode(), dtype=np.uint8)
        buffer = io.BytesIO()
        np.savez(buffer, allow_pickle=False, **arrays)
        return buffer.getvalue()

    def _restore(self, checkpoint: bytes) -> None:
        with np.load(io.BytesIO(checkpoint), allow_pickle=False) as saved:
            arrays = dict(saved)
        facts = json.loads(arrays["facts"].tobytes())
        self.ended = facts["ended"]
        self.waiting = [_run(found, arrays) for found in facts["waiting"]]
        if "bundle" in arrays:
            self._switch(facts["structure"])
            assert self.bundle is not None  # noqa: S101  (switching made it)
            self.bundle.restore(arrays["bundle"].tobytes())
        self.lanes = [found and _run(found, arrays) for found in facts["lanes"]]


def kernel_of(study: Study, structure: int) -> tuple[Kernel, Tangents | None]:
    """Return the kernel of points of one structure, and its tangents where they are wanted."""
    point = int(np.flatnonzero(study.structure == structure)[0])
    kernel = ready_kernel(study.point_scene(point), study.job["formulation"], study.method)
    wanted = "lyapunov" in study.indicators
    return kernel, compile_tangents(kernel) if wanted else None


def _facts(run: PointRun) -> dict[str, Any]:
    names = ("point", "chain", "position", "settled", "reached", "taken", "sampled")
    facts = {name: getattr(run, name) for name in names}
    facts |= {name: len(getattr(run, name)) for name in SERIES}
    return facts | {"starts": run.start is not None}


def _run(facts: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> PointRun:
    starts = facts.pop("starts")
    counts = {name: facts.pop(name) for name in SERIES}
    run = PointRun(**facts)
    for name, count in counts.items():
        setattr(run, name, [arrays[f"{name}{run.point}-{i}"] for i in range(count)])
    if starts:
        names = ("state", "contact", "impact_rate")
        run.start = LaneStart(*(arrays.get(f"start{run.point}-{name}") for name in names))  # type: ignore[arg-type]
    return run
