"""Choice of `"auto"`: the explicit method, unless its steps hardly bring a run on.

Stiffness is measured by what it costs. Where the explicit method makes `ATTEMPTS` within the first
`SHARE` of a period, the implicit one is tried on the same stretch, and takes over from the start if
so much fewer attempts suffice that it is faster, though one takes four to nine times as long. Both
count attempts of one lane, so that a job always chooses alike. A ratio of slope differences (Hairer
and Wanner 1996, IV.2) would not do: where friction chatters, steps are short for its kinks, well
within stability.
"""

from dataclasses import replace

import numpy as np

from jointplay.solver.integrators import AUTO, STIFF
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.lane import Lane
from jointplay.solver.kernels.loop.problem import LaneProblem
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.results import Slice

EXPLICIT, IMPLICIT = AUTO.name, STIFF.name
ATTEMPTS = 1_000_000
"""A thousand times what the press takes for a tenth of a period at the standard tolerance: half a
second, so that loading the implicit kernel and beginning again is soon won back."""
SHARE = 0.1
FEWER = 20
TIGHTER = 1e-3
"""The implicit method gets this share of the tolerance: where friction chatters, its steps pass
over many kinks, so that at the same tolerance it loses up to 600 times the energy that it may."""
LEAST = 1e-13
"""Smallest tolerance of a job."""
PIECE = 100
"""Attempts between looks at how far the implicit method has come."""
LANE = 0


def is_open(admission: Admission) -> bool:
    """Whether the method is chosen only after steps of the explicit one were seen."""
    possible = TIGHTER * admission.tolerance >= LEAST
    return bool(admission.job["method"] == "auto" and admission.method == EXPLICIT and possible)


def reason_for(admission: Admission) -> str:
    """Return why a run begins with its method."""
    if admission.job["method"] != "auto":
        return "asked for"
    if admission.method != EXPLICIT:
        return f"the tolerance is too large for '{EXPLICIT}'"
    return "not stiff" if is_open(admission) else f"the tolerance is too small for '{IMPLICIT}'"


def attempts_left(bundle: Bundle) -> int:
    """Return how many attempts show more about an explicit run; 0: it is over, fast or slow."""
    lane = bundle.lane(LANE)
    return ATTEMPTS - lane.attempts if lane.running and _is_early(lane) else 0


def tightened(problem: LaneProblem) -> LaneProblem:
    """Return a problem with the tolerance that the implicit method gets."""
    return replace(problem, tolerance=TIGHTER * problem.tolerance)


def stiff(bundle: Bundle, problem: LaneProblem, formulation: str) -> str:
    """Return why an explicit run should begin again with the implicit method; empty: it need not.

    Compiles the implicit kernel where it is not cached, which takes seconds.
    """
    lane = bundle.lane(LANE)
    if lane.attempts < ATTEMPTS or not _is_early(lane):
        return ""
    reached = lane.time
    kernel = ready_kernel(problem.scene, formulation, IMPLICIT)
    bare = replace(tightened(problem), output_step=problem.duration, samples=0, sections=0)
    bundle = Bundle(kernel, [bare], watch=False)
    trial = bundle.lane(LANE)
    while trial.time < reached:
        left = ATTEMPTS // FEWER - trial.attempts
        if left <= 0 or not trial.running:
            return ""
        bundle.advance(min(left, PIECE))
    return (
        f"stiff: to {reached:.3g} s, '{EXPLICIT}' attempts {ATTEMPTS} steps and '{IMPLICIT}'"
        f" {trial.attempts} at {bare.tolerance:.2g}, the tolerance that keeps energy as well"
    )


def withheld(found: Slice) -> Slice:
    """Return a slice that tells nothing, while its run may yet begin again."""
    samples, sections = found.samples[:0], found.sections[:0]
    nothing = np.zeros(0)
    rest = (found.impacts[:0], found.steps[:0], found.intervals[:0])
    return Slice(0.0, 0.0, 0, nothing, samples, 0, nothing, sections, *rest)


def joined(slices: list[Slice]) -> Slice:
    """Return consecutive slices as one."""
    first, last = slices[0], slices[-1]
    return Slice(
        last.time,
        last.fraction,
        first.first_sample,
        np.concatenate([each.sample_time for each in slices]),
        np.concatenate([each.samples for each in slices]),
        first.first_section,
        np.concatenate([each.section_time for each in slices]),
        np.concatenate([each.sections for each in slices]),
        np.concatenate([each.impacts for each in slices]),
        np.concatenate([each.steps for each in slices]),
        np.concatenate([each.intervals for each in slices]),
    )


def _is_early(lane: Lane) -> bool:
    return lane.time < SHARE * float(lane.run["unit"])
