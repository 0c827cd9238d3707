"""Reasons of points of which numbers alone are kept, as in charts and basins."""

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.study import StudyDataset
from jointplay.solver.nonlinear.reasons import undecided_reasons
from jointplay.solver.nonlinear.verdict import VERDICTS


def test_undecided_points_have_a_reason_and_no_others() -> None:
    source = StudyDataset(
        attributes={"job": {"kind": "chart"}},
        parameters=(Channel("play", "m", "radial clearance"),),
        values=np.zeros((4, 1)),
        status=np.zeros(4, np.uint8),
        verdicts=np.array([0, 1, 0, -1]),
        verdict_names=list(VERDICTS),
        indicators={
            "verdict": np.array([0.0, 1.0, 0.0, np.nan]),
            "lyapunov": np.array([0.5, -0.5, np.nan, np.nan]),
            "lyapunov_error": np.array([0.01, 0.01, np.nan, np.nan]),
            "period": np.array([2.0, 2.0, 0.0, np.nan]),
        },
    )
    found = undecided_reasons(source, range(4))
    assert list(found) == [0, 2]
    assert "yet neighbours part, the exponent is 0.500 ± 0.010 1/s: chaos in bands" in found[0]
    assert "no short period is seen: the motion may not have settled" in found[2]
    assert "settle for longer" in found[2]
    assert undecided_reasons(source, range(1, 2)) == {}
