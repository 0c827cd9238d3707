"""Admission of the kind ``accuracy-study``: every method at every tolerance, on one scene."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from jointplay.records.failure import LimitExceeded, Problem
from jointplay.solver.admission import documents
from jointplay.solver.admission.limits import BYTES_PER_POINT, LONGEST_ACCURACY_STUDY
from jointplay.solver.admission.points import one_point
from jointplay.solver.admission.spans import periods
from jointplay.solver.admission.studies import make_study
from jointplay.solver.admission.varied import check_points
from jointplay.solver.integrators import METHODS
from jointplay.solver.jobs.accuracy_study import AccuracyStudyJob
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.work_precision.plan import WITHOUT_PERIOD, runs_of


def admit_accuracy_study(job: AccuracyStudyJob, *, thorough: bool = True) -> Study:
    """Check a parsed job and fill in its defaults; its points are the runs, in one block.

    One worker computes them one after the other, so that their seconds can be compared.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field.
    LimitExceeded
        The study is sound but too long; the sentence gives the limit.
    """
    chosen = {
        "methods": [name for name in METHODS if name in job.methods],
        "tolerances": sorted(set(job.tolerances), reverse=True),
    }
    points = one_point(len(runs_of(chosen, 1.0)))
    checked = check_points(job, points, thorough=thorough)
    units = periods(checked)
    unit = WITHOUT_PERIOD if units.notes else float(units.seconds[0])
    duration = job.duration or unit
    if duration > LONGEST_ACCURACY_STUDY * unit:
        sentence = (
            f"{duration:g} s are {duration / unit:.3g} periods of {unit:.3g} s; the limit of an"
            f" accuracy-study is {LONGEST_ACCURACY_STUDY} ({LONGEST_ACCURACY_STUDY * unit:.3g} s)."
            " Errors are compared only as long as the reference is known; ask for less."
        )
        raise LimitExceeded([Problem("/duration", sentence)])
    filled = documents.filled(job, checked.document, checked.echo, duration=duration, **chosen)
    study = make_study(
        job,
        points,
        checked,
        filled,
        period=np.full(points.count, unit),
        offset=np.zeros(points.count),
        settle=np.zeros(points.count),
        duration=np.full(points.count, duration),
        stored_bytes=int(BYTES_PER_POINT * points.count),
    )
    return replace(study, blocks=((0, points.count),))
