"""Openings that a run misses, or makes up: its contacts beside those of a far finer run."""

from typing import NamedTuple

import numpy as np

from benchmarks.openings.runs import Floats, Ran

CERTAIN = 10.0
"""An opening must be as many times as large as the run's error, or nobody can tell."""
SMALLEST = 1e-10
"""The least error that is reckoned with, m."""
LOST = 0.1
"""Error of a depth, in clearances, from which on the motion is another one."""


class Judgement(NamedTuple):
    """Judgement of a run."""

    judged: int
    """Openings of the truth that the run can be told by."""
    missed: tuple[float, ...]
    """When, s, those begin that lie within one contact of the run."""
    made_up: tuple[float, ...]
    """When those of the run begin that lie within one contact of the truth."""
    late: float
    """The largest error of an onset behind one of them, s."""


def judge(run: Ran, truth: Ran, clearance: float) -> Judgement:
    """Compare a run's openings with the truth's until it is another motion."""
    error = np.maximum.accumulate(np.abs(run.depth - truth.depth))
    judged, missed, late = 0, [], 0.0
    for opening, size in zip(truth.openings, truth.sizes, strict=True):
        if not _tells(opening, size, error, truth, clearance):
            continue
        judged += 1
        if _within_contact(opening, run):
            missed.append(float(opening[0]))
        else:
            late = max(late, float(np.min(np.abs(run.onset - opening[1]))))
    made_up = [
        float(opening[0])
        for opening, size in zip(run.openings, run.sizes, strict=True)
        if _tells(opening, size, error, truth, clearance) and _within_contact(opening, truth)
    ]
    return Judgement(judged, tuple(missed), tuple(made_up), late)


def _tells(opening: Floats, size: float, error: Floats, truth: Ran, clearance: float) -> bool:
    """Whether an opening is larger than the run's error before it, and before the horizon."""
    before = int(np.searchsorted(truth.time, opening[0], side="right")) - 1
    so_far = max(float(error[max(before, 0)]), SMALLEST)
    return so_far < LOST * clearance and size > CERTAIN * so_far


def _within_contact(opening: Floats, run: Ran) -> bool:
    """Whether a run is in one contact from before an opening until after it."""
    return bool(np.any((run.onset < opening[0]) & (run.release > opening[1])))
