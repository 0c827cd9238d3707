"""Contacts of runs, and depths at many instants of them."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem

Floats = NDArray[np.float64]

INSTANTS = 2000
"""At which depths are looked at."""
ATTEMPTS = 1000
"""At a step, between two looks at what a bundle hands out: it holds 2048 samples of a lane."""


class Ran(NamedTuple):
    """A run: its contacts, in order, and penetration (m) at instants (s)."""

    onset: Floats
    release: Floats
    """Infinite where the contact lasts."""
    rate: Floats
    """Approach rate, m/s."""
    time: Floats
    depth: Floats
    done: bool

    @property
    def openings(self) -> Floats:
        """Ends, s, of openings between contacts, (openings, 2)."""
        return np.stack([self.release[:-1], self.onset[1:]], axis=1)

    @property
    def sizes(self) -> Floats:
        """Width to which gaps open between contacts, m: a throw that comes back at such a rate."""
        return 0.25 * self.rate[1:] * (self.onset[1:] - self.release[:-1])

    @property
    def open_in_contact(self) -> float:
        """The largest gap, m, at an instant inside a contact; 0 if there is none."""
        which = np.searchsorted(self.onset, self.time, side="right") - 1
        inside = (which >= 0) & (self.time < self.release[which])
        return float(np.max(-self.depth[inside], initial=0.0))


def run(jobs: list[dict[str, Any]]) -> list[Ran]:
    """Run jobs of one structure and one method, as many as a bundle holds at most."""
    assert len(jobs) <= BUNDLE
    admitted = [admit(job | {"output_step": job["duration"] / INSTANTS}) for job in jobs]
    problems = [_problem(each) for each in admitted if isinstance(each, Admission)]
    first = admitted[0]
    assert isinstance(first, Admission)
    kernel = ready_kernel(first.scene, "reduced", first.method)
    bundle = Bundle(kernel, problems, watch=False)
    column = np.array([kernel.rows.index("J.penetration")], dtype=np.int64)
    found: list[tuple[list[Any], ...]] = [([], [], []) for _ in jobs]
    running = len(jobs)
    while running:
        running = bundle.advance(ATTEMPTS)
        for i, (impacts, times, depths) in enumerate(found):
            rows = bundle.rows(SAMPLES, i)
            impacts.append(bundle.impacts(i))
            times.append(bundle.times(i, rows))
            depths.append(bundle.observe(i, rows, column)[:, 0])
    return [
        _ran(bundle.lane(i).status, *(np.concatenate(part) for part in parts))
        for i, parts in enumerate(found)
    ]


def _problem(admission: Admission) -> LaneProblem:
    step, samples = admission.job["output_step"], admission.samples
    duration, tolerance = admission.job["duration"], admission.tolerance
    return LaneProblem(admission.scene, duration, tolerance, step, samples, 0, 0.0)


def _ran(status: Status, impacts: NDArray[np.void], time: Floats, depth: Floats) -> Ran:
    impacts = np.sort(impacts, order="onset")
    release = np.nan_to_num(impacts["release"], nan=np.inf)
    rate = impacts["approach_rate"]
    return Ran(impacts["onset"], release, rate, time, depth, status == Status.DONE)
