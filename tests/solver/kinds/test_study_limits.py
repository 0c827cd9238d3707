"""Studies that are larger than the service takes: refused with the estimate."""

from typing import Any

import pytest

from jointplay.records.failure import LimitExceeded
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.statistics import STATISTICS
from tests.solver.runs.study.jobs_of_studies import (
    ACCURACY_STUDY,
    BIFURCATION,
    ENSEMBLE,
    POINCARE,
    SWEEP,
)


def values(**changes: Any) -> dict[str, Any]:
    return {"from": 1e-4, "to": 1e-3, "count": 10, **changes}


WITHOUT_UNIT = {key: value for key, value in SWEEP.items() if key != "periods"}

TOO_LARGE: dict[str, tuple[dict[str, Any], dict[str, Any], str, str]] = {
    "points of a range": (BIFURCATION, {"values": values(count=10**9)}, "/values", "1e+09 points"),
    "points in both directions": (
        BIFURCATION,
        {"values": values(count=60_000), "continuation": "both"},
        "/values",
        "120000 points",
    ),
    "points of a grid": (
        SWEEP,
        {"grid": {name: values(count=10**6) for name in ("clearance", "friction", "restitution")}},
        "/grid",
        "1e+18 points",
    ),
    "members": (ENSEMBLE, {"members": 10**9}, "/members", "the limit is 100000"),
    "periods of a point": (POINCARE, {"settle": 10**7}, "/settle", "1.000005e+07 periods"),
    "sections of a point": (POINCARE, {"record": 2 * 10**6}, "/record", "the limit is 1e+06"),
    "periods of all points": (
        BIFURCATION,
        {"values": values(count=10_000), "settle": 20_000},
        "/settle",
        "2e+08 periods",
    ),
    "bytes of all sections": (ENSEMBLE, {"members": 1000, "record": 90_000}, "/record", "12.2 GB"),
    "duration of a point": (
        {**WITHOUT_UNIT, "duration": 1e7},
        {},
        "/duration",
        "5000000 periods",
    ),
    "statistics of every channel": (
        SWEEP,
        {"statistics": [*STATISTICS], "channels": ["*"]},
        "/statistics",
        "the limit is 512",
    ),
    "samples of statistics": (
        SWEEP,
        {"statistics": ["mean"], "periods": 9e5, "samples_per_period": 4096},
        "/samples_per_period",
        "the limit is 1e+10",
    ),
    "duration of an accuracy-study": (
        ACCURACY_STUDY,
        {"duration": 201.0},
        "/duration",
        "limit of an",
    ),
    "periods of a sweep": (SWEEP, {"periods": 1e7}, "/periods", "the limit is 1e+06"),
}


@pytest.mark.parametrize("case", TOO_LARGE)
def test_a_study_over_a_limit_is_refused_with_the_estimate(case: str) -> None:
    job, changes, pointer, words = TOO_LARGE[case]
    with pytest.raises(LimitExceeded) as refused:
        admit({**job, **changes})
    found = {problem.pointer: problem.detail for problem in refused.value.problems}
    assert words in found[pointer], found


def test_statistics_of_contacts_take_no_samples() -> None:
    # 1e-4 periods are left, a fortieth of a sample
    assert isinstance(admit({**SWEEP, "statistics": ["impacts"], "settle": 1.9999}), Study)
