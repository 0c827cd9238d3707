"""The record of a point: sections, statistics, extremes, and the end of it."""

from typing import Any

import numpy as np

from jointplay.records.failure import SimulationFailed
from jointplay.records.point import PointEnd, SectionRows
from jointplay.solver.kernels.loop.runs import SAMPLES, SECTIONS, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.lane_results import failure_of, statistics_of
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.runs.study.indicators import MOST_SECTIONS
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_extremes import PointExtremes
from jointplay.solver.runs.study.point_run import (
    PointRun,
    statistics_in,
    take_contacts,
    take_samples,
)
from jointplay.solver.runs.study.rest import state_at_rest

BRIEF = ("steps", "onsets")
WORKS = ("driver_work", "contact_loss", "friction_loss", "gross_work")
OF_SETTLING = ("settled_periods", "settling")
"""Statistics that a brief study keeps, the latter where settling is waited for."""


class Recording:
    """Takes what the lanes of a bundle hand out of the points of a study."""

    def __init__(self, study: Study, bundle: Bundle) -> None:
        self._study, self._bundle = study, bundle
        self.extremes = PointExtremes(study, bundle)
        rows = bundle.kernel.rows
        self._observed, self._sampled = (
            np.array([rows.index(channel.name) for channel in chosen], dtype=np.int64)
            for chosen in (study.observables, study.channels)
        )
        """Rows of the observables, and of the channels, in the kernel's block of channels."""

    def take(self, lane: int, run: PointRun) -> list[SectionRows]:
        """Take what a lane has handed out. Returns new sections, if they are to be recorded."""
        if run.settled >= 0:
            run.growth.append(self._bundle.growth(lane))
        sections = self._sections(lane, run)
        if run.tallies:
            self._tally(lane, run)
        self.extremes.take(lane, run)
        return sections

    def end(self, lane: int, run: PointRun, status: Status) -> PointEnd:
        """Return how a point ended, still without its indicators."""
        bundle, study = self._bundle, self._study
        failure: SimulationFailed | None = None
        if status != Status.DONE:
            failure = failure_of(bundle, lane, study.tolerance, study.point_scene(run.point))
        elif study.indicators:
            settled = run.settled * float(study.period[run.point])
            scene = study.point_scene(run.point)
            run.lasting = lasting_contacts(bundle, lane, scene, settled)
            run.rest = [*state_at_rest(bundle, lane, scene, float(study.period[run.point]))]
        return PointEnd(
            run.point,
            failure.code if failure else "",
            failure.detail if failure else "",
            bundle.lane(lane).time,
            self.extremes.end(lane, run),
            self._statistics(lane, run, whole=failure is None),
            {},
        )

    def _sections(self, lane: int, run: PointRun) -> list[SectionRows]:
        bundle = self._bundle
        rows = bundle.rows(SECTIONS, lane)
        if not len(rows):
            return []
        if run.settled < 0 or (self._study.indicators and run.taken < MOST_SECTIONS):
            run.seen.append(bundle.kernel.row.states(rows).copy())
        if run.settled < 0:
            return []
        first = run.taken
        run.taken += len(rows)
        times = bundle.kernel.row.times(rows, float(self._study.period[run.point]))
        if self._study.ends_with_events and first < MOST_SECTIONS:
            run.moments.append(times)
        if not len(self._observed):
            return []  # sections are looked at, and not kept
        values = bundle.observe(lane, rows, self._observed)
        return [SectionRows(run.point, first, times, values)]

    def _tally(self, lane: int, run: PointRun) -> None:
        """Take a lane's new samples, and the contacts that ended."""
        bundle, study = self._bundle, self._study
        rows = bundle.rows(SAMPLES, lane)
        if len(rows):
            take_samples(study, run, bundle.observe(lane, rows, self._sampled))
        contacts = bundle.impacts(lane)
        if len(contacts):
            take_contacts(study, run, contacts, bundle.lane(lane).time)

    def _statistics(self, lane: int, run: PointRun, *, whole: bool) -> dict[str, float]:
        """Return what every point has; those of channels and contacts too if it ran to its end."""
        found: dict[str, Any] = statistics_of(self._bundle, lane)
        energy = found.pop("energy")
        found["smallest_step"] = found["smallest_step"] or float("nan")
        if self._study.keeps_ledger:
            found |= {name: energy[name] for name in WORKS}
            found["energy_residual"] = energy["residual"]
        found |= {
            "settled_periods": max(run.settled, 0) if self._study.record else float("nan"),
            "settling": run.settling.result.code if run.settling and run.settling.result else 0,
            "from_neighbour": float(run.start is not None),
        }
        if self._study.brief:
            kept = BRIEF if self._study.job["settle"] != "auto" else (*BRIEF, *OF_SETTLING)
            found = {name: found[name] for name in kept}
        if run.tallies and whole:
            reached = self._bundle.lane(lane).time
            found |= statistics_in(self._study, run, self._bundle.kernel.pairs, reached)
        return {name: float(value) for name, value in found.items()}
