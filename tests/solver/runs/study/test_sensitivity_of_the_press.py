"""Two clearances of the press: over them its displacement is a plane, without interactions."""

import numpy as np
import pytest

from jointplay.local import run

WIDTHS = {"clearance_A": (1e-4, 5e-4), "clearance_B": (1e-4, 3e-4)}
JOB = {
    "kind": "sensitivity",
    "scene": {"preset": "seven-bar-press"},
    "parameters": {
        name: {"distribution": "uniform", "low": low, "high": high}
        for name, (low, high) in WIDTHS.items()
    },
    "samples": 64,
    "periods": 1,
    "settle": 0.2,
    "accuracy": "draft",
    "channels": ["displacement"],
    "statistics": ["mean"],
}


def test_first_order_and_total_are_the_shares_of_a_plane():
    job = run(JOB, processes=1)
    found = job.sensitivity("displacement.mean")
    assert found["rows"]["used"] == 64
    first, total = (
        np.array(found["measures"][name]["values"]) for name in ("first_order", "total")
    )
    study = job.study()
    plane = np.column_stack([np.ones(study.points), study.values])
    slopes = np.linalg.lstsq(plane, study.statistics["displacement.mean"], rcond=None)[0][1:]
    parts = (slopes * np.ptp(np.array(list(WIDTHS.values())), axis=1)) ** 2
    shares = parts / parts.sum()
    assert shares[0] == pytest.approx(0.905, abs=0.01)
    assert first == pytest.approx(shares, abs=0.03)
    assert total == pytest.approx(shares, abs=0.03)
    assert total == pytest.approx(first, abs=0.03)
