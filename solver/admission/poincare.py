"""Admission of the kind ``poincare``: the sections of one set of parameters."""

from __future__ import annotations

from jointplay.solver.admission.points import one_point
from jointplay.solver.admission.studies import section_study
from jointplay.solver.jobs.poincare import PoincareJob
from jointplay.solver.runs.study.plan import Study


def admit_poincare(job: PoincareJob, *, thorough: bool = True) -> Study:
    """Check a parsed job and fill in its defaults.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field.
    LimitExceeded
        The study is sound but too large; the sentence gives the estimate.
    """
    return section_study(job, one_point(), thorough=thorough)
