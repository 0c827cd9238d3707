"""The lanes that compute points of one structure, side by side."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import SimulationFailed
from jointplay.records.point import PointEnd, SectionRows
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.runs import SAMPLES, SECTIONS, Status
from jointplay.solver.nonlinear.lyapunov import undecided
from jointplay.solver.runs.lane_results import failure_of, statistics_of
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.runs.study.finer import COST, go_on_finer, go_on_longer, periods_of
from jointplay.solver.runs.study.grounds import limits
from jointplay.solver.runs.study.indicators import (
    MOST_SECTIONS,
    exponents,
    growth_by_period,
    indicators_of,
)
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_extremes import (
    PointExtremes,
    lanes_that_keep_steps,
)
from jointplay.solver.runs.study.point_run import (
    PointRun,
    statistics_in,
    take_contacts,
    take_samples,
)
from jointplay.solver.runs.study.problem import (
    ENDLESS,
    WINDOW,
    most_settling,
    problem_of,
    scales_of,
)

Collected = tuple[list[SectionRows], list[PointEnd], list[PointRun]]
"""Sections, points that ended, and those that may follow them."""


class LaneGroup:
    """A kernel's lanes, each with the point that it computes, or free."""

    def __init__(self, study: Study, structure: int) -> None:
        """Compile or load the kernel of a structure, and its tangents where they are wanted."""
        point = int(np.flatnonzero(study.structure == structure)[0])
        kernel = ready_kernel(study.point_scene(point), study.job["formulation"], study.method)
        tangents = compile_tangents(kernel) if "lyapunov" in study.indicators else None
        self.study = study
        self.structure = structure
        keep_steps = lanes_that_keep_steps(study)
        watch = bool(study.channels)
        self.bundle = Bundle(kernel, watch=watch, tangents=tangents, keep_steps=keep_steps)
        self.extremes = PointExtremes(study, self.bundle)
        self.lanes: list[PointRun | None] = [None] * BUNDLE
        self.columns, self.sampled = (
            np.array([kernel.rows.index(channel.name) for channel in chosen], dtype=np.int64)
            for chosen in (study.observables, study.channels)
        )
        """Rows of the observables, and of the channels, in the kernel's block of channels."""

    @property
    def _carries_exponents(self) -> bool:
        return "lyapunov" in self.study.indicators

    @property
    def busy(self) -> bool:
        """Whether a lane computes a point."""
        return any(run is not None for run in self.lanes)

    @property
    def steps(self) -> float:
        """Accepted steps of the points under way."""
        busy = (self.bundle.lane(i) for i, run in enumerate(self.lanes) if run is not None)
        return float(sum(lane.steps for lane in busy))

    def under_way(self) -> float:
        """Return how many points the parts of those under way amount to."""
        return sum(
            self._computed(lane, run) for lane, run in enumerate(self.lanes) if run is not None
        )

    def _computed(self, lane: int, run: PointRun) -> float:
        """Return how much of a point is computed, 0..1, counted in steps of its record."""
        study, at = self.study, self.bundle.lane(lane)
        whole, stretch = float(study.duration[run.point]), 0.0
        if self._carries_exponents:
            stretch = COST * periods_of(study.record) * float(study.period[run.point])
        if run.ended is None:
            return min(at.time, whole) / (whole + stretch)
        return max(1.0 - COST * (float(at.run["duration"]) - at.time) / (whole + stretch), 0.0)

    def fill(self, waiting: list[PointRun]) -> tuple[int, ...]:
        """Give free lanes waiting points of this structure; return those points."""
        started = []
        for lane in range(BUNDLE):
            if self.lanes[lane] is not None:
                continue
            fitting = (run for run in waiting if self.study.structure[run.point] == self.structure)
            run = next(fitting, None)
            if run is None:
                break
            waiting.remove(run)
            self.lanes[lane] = run
            self.bundle.load(lane, problem_of(self.study, self.bundle.kernel, run))
            started.append(run.point)
        return tuple(started)

    def collect(self) -> Collected:
        """Take the rows of all lanes and free those whose points are over."""
        sections: list[SectionRows] = []
        ended: list[PointEnd] = []
        following: list[PointRun] = []
        for lane, run in enumerate(self.lanes):
            if run is None:
                continue
            status = self.bundle.lane(lane).status
            if run.ended is None:
                sections += self._recorded(lane, run)
                if status == Status.DONE and self._goes_on(lane, run):
                    continue
                if status != Status.RUNNING:
                    run.ended = self._end(lane, run, status)
                    following += self._following(lane, run, run.ended)
                    if self._looks_again(lane, run):
                        continue
            else:
                run.finer.append(self.bundle.growth(lane))
                if status == Status.DONE and self._looks_longer(lane, run):
                    continue
            if status != Status.RUNNING:
                ended.append(self._judged(run))
                self.lanes[lane] = None
        return sections, ended, following

    def _recorded(self, lane: int, run: PointRun) -> list[SectionRows]:
        """Take what a lane has handed out; return new sections, if they are to be recorded."""
        if run.settled >= 0:
            run.growth.append(self.bundle.growth(lane))
        sections = self._rows(lane, run)
        if run.tallies:
            self._tally(lane, run)
        self.extremes.take(lane, run)
        return sections

    def _looks_again(self, lane: int, run: PointRun) -> bool:
        """Let a point whose exponent is wanted go on in smaller steps; whether it does."""
        study = self.study
        if run.ended is None or run.ended.code or not self._carries_exponents:
            return False
        period = float(study.period[run.point])
        scene = study.point_scene(run.point)
        run.finer_from = go_on_finer(
            self.bundle, lane, scene, study.tolerance, period, study.record
        )
        return True

    def _looks_longer(self, lane: int, run: PointRun) -> bool:
        """Lengthen the stretch in smaller steps while it settles nothing; whether it does."""
        study = self.study
        period = float(study.period[run.point])
        if not undecided(*exponents(*self._growths(run), period, run.settled)):
            return False
        scene = study.point_scene(run.point)
        return go_on_longer(self.bundle, lane, scene, run.finer_from, period, study.record)

    def _judged(self, run: PointRun) -> PointEnd:
        """Return a point's end with its indicators, for which now all is there."""
        assert run.ended is not None  # noqa: S101  (narrows the type)
        if run.ended.code or not self.study.indicators:
            return run.ended
        found, reason = self._indicators(run)
        return replace(run.ended, indicators=found, reason=reason)

    def _rows(self, lane: int, run: PointRun) -> list[SectionRows]:
        """Return a lane's new sections, if they are to be recorded."""
        bundle = self.bundle
        rows = bundle.rows(SECTIONS, lane)
        if not len(rows):
            return []
        times = bundle.kernel.row.times(rows, float(self.study.period[run.point]))
        if run.settled < 0 or (self.study.indicators and run.taken < MOST_SECTIONS):
            run.seen.append(bundle.kernel.row.states(rows).copy())
        if run.settled < 0:
            return []
        values = bundle.observe(lane, rows, self.columns)
        first = run.taken
        run.taken += len(rows)
        return [SectionRows(run.point, first, times, values)]

    def _tally(self, lane: int, run: PointRun) -> None:
        """Take a lane's new samples, and the contacts that ended."""
        bundle, study = self.bundle, self.study
        rows = bundle.rows(SAMPLES, lane)
        if len(rows):
            take_samples(study, run, bundle.observe(lane, rows, self.sampled))
        contacts = bundle.impacts(lane)
        if len(contacts):
            take_contacts(study, run, contacts)

    def _goes_on(self, lane: int, run: PointRun) -> bool:
        """Give a lane at the end of a leg the next one; return whether there was one."""
        if run.settled >= 0:
            return False
        study, point, bundle = self.study, run.point, self.bundle
        scene = study.point_scene(point)
        period = float(study.period[point])
        most = most_settling(study, point)
        scales, angles = scales_of(study, bundle.kernel, point)
        if run.reached < most and not run.has_settled(scales, angles, most):
            run.reached = min(run.reached + WINDOW, most)
            bundle.extend(lane, scene, run.reached * period, ENDLESS)
            return True
        run.settled = run.reached
        run.seen = []
        left = float(study.duration[point] - study.settle[point])
        taken = int(bundle.lane(lane).run["next"][SECTIONS])
        bundle.extend(lane, scene, run.settled * period + left, taken + study.record)
        return True

    def _end(self, lane: int, run: PointRun, status: Status) -> PointEnd:
        """Close a point."""
        bundle, study = self.bundle, self.study
        failure: SimulationFailed | None = None
        if status != Status.DONE:
            failure = failure_of(bundle, lane, study.tolerance, study.point_scene(run.point))
        elif study.indicators:
            settled = run.settled * float(study.period[run.point])
            scene = study.point_scene(run.point)
            run.lasting = lasting_contacts(bundle, lane, scene, settled)
        return PointEnd(
            run.point,
            failure.code if failure else "",
            failure.detail if failure else "",
            bundle.lane(lane).time,
            self.extremes.end(lane, run),
            self._statistics(lane, run, whole=failure is None),
            {},
        )

    def _following(self, lane: int, run: PointRun, end: PointEnd) -> Iterator[PointRun]:
        """Yield the next point of a chain, which starts where this one came to."""
        order, position = self.study.chain_order[run.chain], run.position + 1
        if position < len(order):
            start = None if end.code else self.bundle.state_of(lane)
            yield PointRun(order[position], run.chain, position, start)

    def _indicators(self, run: PointRun) -> tuple[dict[str, float], str]:
        """Return the indicators of a point, and the grounds of its verdict."""
        kernel, study = self.bundle.kernel, self.study
        states = np.concatenate(run.seen) if run.seen else np.zeros((0, kernel.states))
        scales, angles = scales_of(study, kernel, run.point)
        period = float(study.period[run.point])
        growths = self._growths(run)
        found, verdict = indicators_of(
            study.indicators, states, scales, angles, *growths, period, run.settled
        )
        sections, periods = len(states[:MOST_SECTIONS]), len(growths[0])
        remarks = limits(study.point_scene(run.point), found, sections, periods)
        return found, "; ".join(filter(None, [verdict.reason, run.lasting, *remarks]))

    def _growths(self, run: PointRun) -> tuple[Floats, Floats]:
        """Return logarithms of the tangent's growth by period: in the record, and behind it."""
        period = float(self.study.period[run.point])
        growth, finer = (
            growth_by_period(np.concatenate([np.zeros((0, 2)), *rows]), period, since)
            for rows, since in ((run.growth, run.settled), (run.finer, run.finer_from))
        )
        return growth, finer

    def _statistics(self, lane: int, run: PointRun, *, whole: bool) -> dict[str, float]:
        """Return what every point has; those of channels and contacts too if it ran to its end."""
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
            found |= statistics_in(self.study, run, self.bundle.kernel.pairs)
        return {name: float(value) for name, value in found.items()}
