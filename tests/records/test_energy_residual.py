"""The energy residual of accuracy-studies is read under the name that each version stored it by."""

import numpy as np
import pytest

from jointplay.records.energy_residual import relative_energy_residuals
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision

RUN = {"method": "tsitouras", "tolerance": 1e-6, "step": None, "admitted": True, "reference": False}


def stored(**residual: float) -> StudyDataset:
    """Two references and a run, with a number of the run by the name in a store."""
    statistics = {"evaluations": 9.0, "steps": 2.0, "seconds": 0.1, "error": 1e-3, **residual}
    return StudyDataset(
        attributes={
            "job": {"kind": "accuracy-study", "duration": 1.0},
            "runs": [RUN | {"reference": True}] * 2 + [RUN],
        },
        parameters=(),
        values=np.empty((3, 0)),
        status=np.full(3, PointStatus.done, np.uint8),
        statistics={name: np.full(3, value) for name, value in statistics.items()},
    )


@pytest.mark.parametrize(
    ("residual", "expected"),
    [({"relative_energy_residual": 0.25}, 0.25), ({"astray": 0.125}, 0.125), ({}, None)],
    ids=["this version", "version 0.1.0", "not yet"],
)
def test_it_is_found_by_both_names(residual: dict[str, float], expected: float | None) -> None:
    study = stored(**residual)
    (run,) = WorkPrecision.of(study).points
    assert run.relative_energy_residual == expected
    assert np.isnan(relative_energy_residuals(study)).all() == (expected is None)
