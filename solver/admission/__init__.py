"""Admission: a job document is checked whole and filled in before anything is queued.

One module a kind; `admit` is the way in for all of them.
"""

from __future__ import annotations

from collections.abc import Callable

from solver.admission.accuracy_study import admit_accuracy_study
from solver.admission.bifurcation import admit_bifurcation
from solver.admission.documents import parse
from solver.admission.ensemble import admit_ensemble
from solver.admission.limits import LONGEST_RUN, MOST_BYTES, MOST_SAMPLES
from solver.admission.mechanism import check, resolve
from solver.admission.poincare import admit_poincare
from solver.admission.simulate import Admission, admit_simulate, sample_count
from solver.admission.sweep import admit_sweep
from solver.drive import section_offset
from solver.jobs import SimulateJob
from solver.study.plan import Study

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
