"""Admission of the kind ``ensemble``: one set of parameters from many perturbed starts."""

from __future__ import annotations

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.admission.points import one_point
from jointplay.solver.admission.studies import check_count, section_study
from jointplay.solver.jobs.ensemble import EnsembleJob
from jointplay.solver.runs.study.plan import Study


def admit_ensemble(job: EnsembleJob, *, thorough: bool = True) -> Study:
    """Check a parsed job and fill in its defaults; its points are the members.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field.
    LimitExceeded
        The study is sound but too large; the sentence gives the estimate.
    """
    check_count(job.members, "/members")
    if job.formulation != "reduced":
        raise InvalidInput(
            [
                Problem(
                    "/formulation",
                    "The starts of an ensemble differ in joint coordinates, which only the"
                    " formulation 'reduced' has; choose that.",
                )
            ]
        )
    return section_study(job, one_point(job.members), thorough=thorough)
