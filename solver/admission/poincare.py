"""Admission of the kind ``poincare``: the sections of one set of parameters."""

from __future__ import annotations

from solver.admission.points import one_point
from solver.admission.studies import section_study
from solver.jobs.poincare import PoincareJob
from solver.study.plan import Study


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
