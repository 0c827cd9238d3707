"""Admission: a job document is checked whole and filled in before anything is queued.

One module a kind; `admit` is the way in for all of them.
"""

from __future__ import annotations

from collections.abc import Callable

from jointplay.solver.admission.accuracy_study import admit_accuracy_study
from jointplay.solver.admission.bifurcation import admit_bifurcation
from jointplay.solver.admission.documents import parse
from jointplay.solver.admission.ensemble import admit_ensemble
from jointplay.solver.admission.limits import LONGEST_RUN, MOST_BYTES, MOST_SAMPLES
from jointplay.solver.admission.mechanism import check, resolve
from jointplay.solver.admission.poincare import admit_poincare
from jointplay.solver.admission.simulate import Admission, admit_simulate, sample_count
from jointplay.solver.admission.sweep import admit_sweep
from jointplay.solver.jobs import SimulateJob
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.periods import section_offset

__all__ = [
    "LONGEST_RUN",
    "MOST_BYTES",
    "MOST_SAMPLES",
    "Admission",
    "Study",
    "admit",
    "admit_simulate",
    "check",
    "readmit",
    "resolve",
    "sample_count",
    "section_offset",
]

ADMIT: dict[str, Callable[..., Study]] = {
    "bifurcation": admit_bifurcation,
    "sweep": admit_sweep,
    "poincare": admit_poincare,
    "ensemble": admit_ensemble,
    "accuracy-study": admit_accuracy_study,
}


def admit(document: object) -> Admission | Study:
    """Check a job document of any kind and fill in its defaults.

    Parameters
    ----------
    document
        What a client sent, parsed from JSON.

    Returns
    -------
    Admission or Study
        An admission for the kind ``simulate``, a study for all others.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field.
    LimitExceeded
        The job is sound but too large; the sentence gives the estimate.
    """
    job = parse(document)
    return admit_simulate(job) if isinstance(job, SimulateJob) else ADMIT[job.kind](job)


def readmit(document: object) -> Admission | Study:
    """Return what `admit` returns for a job that was admitted before, sooner.

    Left out is what may take seconds and can only refuse: putting together each geometry of a
    study, following the ideal mechanism to see whether a channel crosses a value.

    Raises
    ------
    InvalidInput
        As `admit`, but for what is left out.
    """
    job = parse(document)
    if isinstance(job, SimulateJob):
        return admit_simulate(job)
    return ADMIT[job.kind](job, thorough=False)
