"""Admission: a job document is checked whole and filled in before anything is queued.

One module a kind; `admit` is the way in for all of them.
"""

from __future__ import annotations

from solver.admission.bifurcation import admit_bifurcation
from solver.admission.documents import parse
from solver.admission.limits import LONGEST_RUN, MOST_BYTES, MOST_SAMPLES
from solver.admission.mechanism import check, resolve
from solver.admission.simulate import Admission, admit_simulate, sample_count
from solver.drive import section_offset
from solver.errors import InvalidInput, Problem
from solver.jobs import BifurcationJob, SimulateJob
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
    "resolve",
    "sample_count",
    "section_offset",
]


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
    if isinstance(job, SimulateJob):
        return admit_simulate(job)
    if isinstance(job, BifurcationJob):
        return admit_bifurcation(job)
    raise InvalidInput([Problem("/kind", f"Jobs of kind '{job.kind}' cannot be run yet.")])
