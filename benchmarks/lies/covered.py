"""Share of a certified run's true error that its bars cover, by an independent program."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.lies.contacts import contacts_hold
from benchmarks.lies.run import Finished, Onsets, finish
from benchmarks.lies.scenes import OTHERS
from benchmarks.lies.sizes import sizes
from benchmarks.lies.truth import true_channels
from jointplay.records.certificate import converged
from jointplay.solver.integrators import COARSE, STIFF
from jointplay.worker.certificates import record_of

Floats = NDArray[np.float64]


class Truths(NamedTuple):
    """Values at some instants, (instants, channels), and by coarser steps."""

    fine: Floats
    coarse: Floats
    onsets: tuple[Onsets, Onsets]


Tell = Callable[[dict[str, Any], NDArray[np.int64]], Truths | None]
"""Takes a job and indices of its samples."""

PROGRAMS = ((1e-12, 1.0), (1e-11, 0.7))
"""Tolerances of the independent program, and shares of its longest steps."""
IMPLICIT = (1e-9, 4e-9)
"""Tolerances of the implicit method."""
FINER = (1e-12, 1e-11)
"""Tolerances of the method of order eight where the independent program does not know a scene."""
DOUBT = 0.1
"""Where the two truths are apart by this share of what is judged, none is known."""
ROUNDING = 1e-12
"""Share of a channel's size that rounding alone makes an error of."""
FINER_STEPS = 200_000
"""Steps after which finer runs give up."""
MOST_ATTEMPTS = 60_000
"""Steps after which the independent program gives up: friction held by steep ramps is stiff."""
SMALLEST = 1e-300
"""Size of what vanishes in the whole run, so that nothing is divided by zero."""
MOST_RATIOS = 400
"""Ratios of bar to error that are kept of a run, for the median."""


@dataclass(frozen=True)
class Verdict:
    """Outcome of a job's claims.

    Attributes
    ----------
    ended : str
        ``judged``, ``no truth``, ``nothing claimed``, or how the run failed.
    errors, inside : int
        Errors whose truth is known, over channels and instants that are converged; those that
        their bar covers.
    worst : float
        Largest error in bars; the bar counts as no less than rounding.
    where : str
        Channel and time of that.
    ratios : (count,) bars by errors, of some errors.
    contacts : int
        Certified contacts, where the truth knows contacts.
    untrue : int
        1 where they are not those of the motion, else 0.
    """

    ended: str
    errors: int = 0
    inside: int = 0
    worst: float = 0.0
    where: str = ""
    ratios: Floats = field(default_factory=lambda: np.zeros(0))
    contacts: int = 0
    untrue: int = 0

    @property
    def covered(self) -> float:
        """Share of the errors that their bars cover."""
        return self.inside / self.errors if self.errors else 1.0


def coverage_of(job: dict[str, Any], tell: Tell | None = None) -> Verdict:
    """Run a job with its certificate and compare its errors with its bars.

    tell : who tells the truth; none: the independent program, or finer runs where it cannot.
    """
    if tell is None and not knows(job["scene"]):
        tell = by_finer_runs
    certified = finish(job | {"certificate": True})
    if not isinstance(certified, Finished):
        return Verdict(certified)
    certificate = certified.certificate
    assert certificate is not None  # it was asked for
    time = certificate.time
    if not len(time):
        return Verdict("nothing claimed")
    within = converged(record_of(certificate), time)
    index = np.round(time[within] / float(time[1])).astype(int)
    if not index[-1]:
        return Verdict("nothing claimed")
    sampled = job | {"certificate": False, "output_step": float(time[1])}
    finished = finish(sampled)
    assert isinstance(finished, Finished)  # samples change nothing
    truths = by_program(finished, index) if tell is None else tell(sampled, index)
    if truths is None:
        return Verdict("no truth")
    values, bar = finished.samples[index], certificate.error[within]
    fine, coarse, onsets = truths
    rounding = ROUNDING * sizes(finished.scene, finished.units, fine) + SMALLEST
    error, doubt = np.abs(values - fine), np.abs(fine - coarse)
    known = doubt <= DOUBT * np.maximum(bar, error) + rounding
    inside = error <= bar + rounding
    if not known.any():
        return Verdict("no truth")
    bars = np.where(known, error / (bar + rounding), 0.0)
    instant, column = np.unravel_index(int(bars.argmax()), bars.shape)
    usable = known & (error > rounding)
    ratios = bar[usable] / error[usable]
    impacts = certificate.facts["impacts"]
    hold = contacts_hold(impacts, certified.onsets, onsets, job["duration"])
    return Verdict(
        "judged",
        int(known.sum()),
        int((known & inside).sum()),
        float(bars.max()),
        f"{finished.names[column]} at {time[within][instant]:.6g} s",
        ratios[:: max(1, len(ratios) // MOST_RATIOS)],
        0 if hold is None else impacts["certified"],
        int(hold is False),
    )


def by_program(finished: Finished, index: NDArray[np.int64]) -> Truths | None:
    """Return what the independent program says, at two tolerances, at some of a run's samples."""
    first = dict(zip(finished.names, finished.samples[0], strict=True))
    truths, onsets = [], []
    for tolerance, share in PROGRAMS:
        found = true_channels(
            finished.scene, first, finished.time[index], tolerance, share, MOST_ATTEMPTS
        )
        if found is None:
            return None
        truths.append(np.stack([found.values[name] for name in finished.names], axis=1))
        onsets.append(found.onsets)
    return Truths(truths[0], truths[1], (onsets[0], onsets[1]))


def knows(scene: dict[str, Any]) -> bool:
    """Tell whether the independent program knows all that is in a scene of a search."""
    clearances = [one.get("clearance", {}) for one in scene.get("joints", {}).values()]
    return (
        scene.get("preset") not in OTHERS
        and not any(j["type"] == "roller-follower" for j in scene.get("joints", {}).values())
        and not any("dissipation" in each.get("contact", {}) for each in clearances)
        and not any("bristle_stiffness" in each.get("friction", {}) for each in clearances)
    )


def by_implicit_method(job: dict[str, Any], index: NDArray[np.int64]) -> Truths | None:
    """Return what far finer runs by the implicit method say.

    The independent program is explicit, and would take minutes where friction is that steep.
    """
    return _by_runs(job, index, STIFF.name, IMPLICIT)


def by_finer_runs(job: dict[str, Any], index: NDArray[np.int64]) -> Truths | None:
    """Return what far finer runs by another method, in the other formulation, say."""
    other = "reduced" if job.get("formulation") == "lagrange" else "lagrange"
    return _by_runs(job | {"formulation": other}, index, COARSE.name, FINER)


def _by_runs(
    job: dict[str, Any], index: NDArray[np.int64], method: str, tolerances: tuple[float, float]
) -> Truths | None:
    same = {name: value for name, value in job.items() if name != "step"}
    same["duration"] = min((index[-1] + 0.5) * job["output_step"], job["duration"])
    runs = [finish(same | {"method": method, "tolerance": t}, FINER_STEPS) for t in tolerances]
    fine, coarse = (run if isinstance(run, Finished) else None for run in runs)
    if fine is None or coarse is None:
        return None
    return Truths(fine.samples[index], coarse.samples[index], (fine.onsets, coarse.onsets))
