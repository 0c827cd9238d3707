"""Seven companions of a trajectory, in the other lanes of its bundle.

Four make a ladder of tolerances, and of longest steps; two start a little beside the scene's start,
by about the error that one step may make; one is the trajectory itself, so that what only its own
steps did is seen, too.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats, Integers
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.quantities.scalars import power
from jointplay.solver.runs.certificate.instants import Instants
from jointplay.solver.runs.starts import Perturbation, perturbed_start, start_scales

RUN = 0
"""Lane of the trajectory itself."""
RATIO = 2.0
LADDER = (RATIO**-2, RATIO**-1, RATIO, RATIO**2)
"""Tolerances of lanes 1 to 4, in the run's own; the first decides what all this costs."""
TIGHTEST, TIGHTER = 1, 2
LOOSER = (3, 4)
PERTURBED = (5, 6)
"""Lanes with the run's own tolerance and another start."""
SHORTER = 0.9
"""Ratio of fixed steps from one of them to the next: with the trajectory's own, all onsets would be
late by the same part of a step."""
TWIN = 7
"""The trajectory again, bit for bit, but handed out at the instants of the certificate."""
SEED = 5
SHORT = 4.0
"""Runs of fewer periods record extremes in fewer lanes: there each record costs most."""
LOUD, LOUD_IN_SHORT = (TIGHTEST, TIGHTER, *PERTURBED), (TIGHTEST, PERTURBED[0])
"""Lanes that seek extremes."""
MOST_CONTACTS = 16_384
"""Contacts that are compared of each lane, the first ones."""
ONSETS = np.dtype([("joint", "<i4"), ("onset", "<f8")])
"""Facts of a contact that are kept: index of its pair, and when it began, s."""
MOST_ATTEMPTS = 1.6
"""Multiple of the run's own attempts: companions that need more are left behind where they are."""


@dataclass
class Companions:
    """Lanes 1 to 7 of a bundle: `collect` after every advance, `allowance` before."""

    bundle: Bundle
    instants: Instants
    loud: tuple[int, ...]
    rows: dict[int, list[Floats]]
    """By lane, dense states at the instants reached so far."""
    contacts: dict[int, list[NDArray[np.void]]]
    """By lane, contacts that have ended, of dtype `ONSETS`, `MOST_CONTACTS` at most."""
    forgotten_from: float = math.inf
    """Earliest onset of a contact that was not kept, s."""

    @classmethod
    def beside(cls, bundle: Bundle, problem: LaneProblem) -> Companions:
        """Load companions of the trajectory that a bundle has in its first lane."""
        period, step = float(bundle.lane(RUN).run["period"]), problem.step
        instants = Instants.over(problem.duration, period)
        start = bundle.state_of(RUN)
        if problem.start is None:
            start = LaneStart(start.state)  # contacts latch their rates at the scene's start
        start = replace(start, closed=True)  # the trajectory's, to the last bit
        coarse = replace(
            problem,
            output_step=instants.finest,
            samples=instants.last + 1,
            sections=0,
            start=start,
        )
        longer = [power(factor, 1.0 / bundle.kernel.tableau.order) for factor in LADDER]
        rungs = [
            replace(coarse, tolerance=problem.tolerance * factor, step=step and step * length)
            for factor, length in zip(LADDER, longer, strict=True)
        ]
        bundle.load_together({**dict(enumerate(rungs, start=1)), TWIN: coarse}, like=RUN)
        for lane, length in enumerate(longer, start=1):
            bundle.lane(lane)["largest_step"] = bundle.lane(RUN)["largest_step"] * length
        scales = start_scales(problem.scene, bundle.kernel.coordinates, period)
        perturbation = Perturbation(problem.tolerance, SEED)
        beside: dict[int, LaneProblem] = {}
        for member, lane in enumerate(PERTURBED, start=1):
            state = perturbed_start(start.state, scales, perturbation, member)
            shorter = step and step * SHORTER**member
            own = replace(start, state=state, closed=False)
            beside[lane] = replace(coarse, start=own, step=shorter)
        bundle.load_together(beside, like=RUN)
        loud = LOUD if problem.duration >= SHORT * period else LOUD_IN_SHORT
        for lane in range(1, BUNDLE):
            if lane not in loud:  # no value is a record
                bundle.lane(lane)["highest"] = math.inf
                bundle.lane(lane)["lowest"] = -math.inf
        lanes = range(1, BUNDLE)
        return cls(
            bundle, instants, loud, {lane: [] for lane in lanes}, {lane: [] for lane in lanes}
        )

    @property
    def running(self) -> bool:
        """Whether any has not come to its end."""
        return any(lane.running for lane in self._lanes)

    @property
    def time(self) -> float:
        """Simulated time that all have reached that still run, s."""
        times = [lane.time for lane in self._lanes if lane.running]
        return min(times, default=self.instants.duration)

    @property
    def _lanes(self) -> list[Lane]:
        return [self.bundle.lane(lane) for lane in range(1, BUNDLE)]

    def allowance(self, budget: int) -> int:
        """Return how many attempts may be made now, and stop who has made all that it may.

        Attempts are each lane's own, so that where a companion is left behind does not depend on
        how the run was sliced.
        """
        run = self.bundle.lane(RUN)
        if run.running:
            return budget
        most = math.ceil(MOST_ATTEMPTS * run.attempts)
        for lane in self._lanes:
            if not lane.running:
                continue
            left = most - lane.attempts
            if left > 0:
                budget = min(budget, left)
                continue
            lane.end(Status.STEP_LIMIT)
        return budget

    def collect(self) -> None:
        """Keep what was handed out, and let later instants lie farther apart."""
        for i in self.rows:
            self._keep_contacts(i)
            rows = self.bundle.rows(SAMPLES, i)
            if not len(rows):
                continue
            lane = self.bundle.lane(i)
            stride = round(lane.run["output_step"] / self.instants.finest)
            following = int(lane.run["next"][SAMPLES])
            coarser = self.instants.stride(min(following * stride, self.instants.last))
            if coarser > stride:
                index = range((following - len(rows)) * stride, following * stride, stride)
                rows = rows[[i % self.instants.stride(i) == 0 for i in index]]
                self._coarsen(i, following, stride, coarser)
            self.rows[i].append(rows.copy())

    def _keep_contacts(self, lane: int) -> None:
        ended = self.bundle.impacts(lane)
        if not len(ended):
            return
        found = np.empty(len(ended), ONSETS)
        found["joint"], found["onset"] = ended["joint"], ended["onset"]
        room = MOST_CONTACTS - sum(map(len, self.contacts[lane]))
        if room > 0:
            self.contacts[lane].append(found[:room])
        self.forgotten_from = min([self.forgotten_from, *found["onset"][max(room, 0) :]])

    def _coarsen(self, i: int, following: int, stride: int, coarser: int) -> None:
        lane = self.bundle.lane(i)
        lane.run["output_step"] = coarser * self.instants.finest
        lane.run["next"][SAMPLES] = -(-following * stride // coarser)
        lane.run["stop"][SAMPLES] = self.instants.last // coarser + 1
        self.bundle.plan_anew(i)

    def checkpoint(self) -> dict[str, NDArray[Any]]:
        """Return arrays that `restore` takes; the lanes' own state is the bundle's."""
        rows = {f"companion{lane}": self.dense(lane) for lane in self.rows}
        contacts = {f"contacts{lane}": self.ended_contacts(lane) for lane in self.contacts}
        return {**rows, **contacts, "forgotten_from": np.array(self.forgotten_from)}

    def restore(self, saved: Mapping[str, NDArray[Any]]) -> None:
        """Continue from a checkpoint."""
        self.rows = {lane: [saved[f"companion{lane}"]] for lane in self.rows}
        self.contacts = {lane: [saved[f"contacts{lane}"]] for lane in self.contacts}
        self.forgotten_from = float(saved["forgotten_from"])

    def dense(self, lane: int) -> Floats:
        """Return a lane's dense states, (instants reached, width)."""
        width = self.bundle.kernel.row.width
        return np.concatenate([np.zeros((0, width)), *self.rows[lane]])

    def ended_contacts(self, lane: int) -> NDArray[np.void]:
        """Return contacts of a lane that have ended, of dtype `ONSETS`, in the order of ends."""
        return np.concatenate([np.zeros(0, ONSETS), *self.contacts[lane]])

    @property
    def compared(self) -> int:
        """Number of instants that the trajectory has reached: none beyond is compared."""
        reached = int(np.searchsorted(self.instants.time, self.bundle.lane(RUN).time, "right"))
        if self.bundle.lane(RUN).status == Status.DONE:
            reached = len(self.instants.index)
        return max(min(reached, len(self.dense(TWIN))), 1)

    def values(self, columns: Integers) -> Floats:
        """Return channels of lanes 1 to 7, (7, instants, columns); NaN: not reached.

        Instants are those that the trajectory has reached, of companions that came further, too.
        """
        found = np.full((BUNDLE - 1, self.compared, len(columns)), np.nan)
        for lane in range(1, BUNDLE):
            rows = self.dense(lane)[: self.compared]
            found[lane - 1, : len(rows)] = self.bundle.observe(lane, rows, columns)
        return found
