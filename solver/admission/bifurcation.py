"""Admission of the kind ``bifurcation``: sections over the values of one parameter."""

from __future__ import annotations

from jointplay.solver.admission.points import one_axis
from jointplay.solver.admission.studies import check_count, section_study
from jointplay.solver.admission.written import axis
from jointplay.solver.jobs.bifurcation import BifurcationJob
from jointplay.solver.jobs.values import count
from jointplay.solver.runs.study.plan import Study


def admit_bifurcation(job: BifurcationJob, *, thorough: bool = True) -> Study:
    """Check a parsed job and fill in its defaults.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field or value.
    LimitExceeded
        The study is sound but too large; the sentence gives the estimate.
    """
    twice = 2 if job.continuation == "both" else 1
    check_count(twice * count(job.values), "/values")
    points = one_axis(axis(job.parameter, job.values, "/parameter", "/values"))
    return section_study(
        job, points, thorough=thorough, continuation=job.continuation, chains=job.chains
    )
