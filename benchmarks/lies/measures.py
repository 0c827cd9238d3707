"""Measures of searches: error bars that are too short, and extremes that are wrong."""

from typing import Any

import numpy as np

from benchmarks.lies.covered import Verdict, coverage_of
from benchmarks.lies.extremes import ALLOWED, Extremes, extremes_of
from benchmarks.lies.search import Measure
from benchmarks.lies.tables import percent

FEW = 0.95
"""Share of its errors that the bars of every run are to cover."""


def _badness_of_bars(found: Verdict) -> float:
    """Return what is not covered, then how many bars the worst error has."""
    return found.untrue + 1.0 - found.covered + 1e-3 * float(np.log10(found.worst + 1e-12))


def _row_of_bars(group: list[Verdict]) -> tuple[str, ...]:
    inside, errors = sum(v.inside for v in group), sum(v.errors for v in group)
    ratios = np.concatenate([v.ratios for v in group])
    covered = [v.covered for v in group]
    return (
        percent(inside / errors),
        percent(min(covered)),
        str(sum(share < FEW for share in covered)),
        f"{max(v.worst for v in group):.3g}",
        f"{np.median(ratios):.3g}" if len(ratios) else "",
        f"{sum(v.contacts for v in group)}, {sum(v.untrue for v in group)}",
    )


def _row_of_extremes(group: list[Extremes]) -> tuple[str, ...]:
    right, extremes = sum(f.right for f in group), sum(f.extremes for f in group)
    return (
        str(extremes),
        str(extremes - right),
        str(sum(f.right < f.extremes for f in group)),
        f"{max(f.worst for f in group):.2g}",
    )


MEASURES: dict[str, Measure[Any]] = {
    "coverage": Measure(
        Verdict,
        coverage_of,
        _badness_of_bars,
        (
            "errors inside",
            "worst run",
            f"runs below {percent(FEW)}",
            "worst error in bars",
            "median bar / error",
            "certified contacts, runs where they are not true",
        ),
        _row_of_bars,
        lambda v: (
            f"{percent(v.covered)} inside, {v.worst:.3g} bars: {v.where}; of {v.contacts} certified"
            f" contacts {'not all' if v.untrue else 'none un'}true"
        ),
    ),
    "extremes": Measure(
        Extremes,
        extremes_of,
        lambda found: found.worst,
        ("extremes", f"off by more than {ALLOWED:g}", "runs with one", "worst"),
        _row_of_extremes,
        lambda found: f"{found.worst:.3g} of its range: {found.where}",
    ),
}
