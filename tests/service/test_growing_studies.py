"""Studies read over HTTP while they wait, while they run, and when they ended early."""

import numpy as np
import pytest
import zarr

from jointplay.records.job import JobError
from jointplay.storage.catalogue.records import BlockState
from tests.service.answers import get
from tests.worker_by_hand import ACCURACY_STUDY, BIFURCATION, SWEEP

OBSERVED = "A.eccentricity_x"


def test_statistics_of_a_running_sweep_are_arrays_with_units(http, service_url, worker):
    job = worker.submit(**SWEEP)
    worker.compute(worker.start(job), points=3)
    store = zarr.open_group(f"{service_url}/v1/jobs/{job}/zarr", mode="r", zarr_format=3)
    mean = store["statistics/A.normal_force.mean"]
    assert mean.attrs["units"] == "N"
    assert mean[:3].tolist() == [0.0, 0.5, 1.0]
    assert np.isnan(mean[3:]).all()


def test_a_study_can_be_read_while_it_runs(http, worker):
    job = worker.submit(**BIFURCATION)
    waiting = get(http, f"/v1/jobs/{job}/bifurcation", 409)
    assert "first ones are computed" in waiting["detail"]
    worker.compute(worker.start(job, 1), points=3, sections=2)
    found = get(http, f"/v1/jobs/{job}/bifurcation", observable=OBSERVED)
    assert found["complete"] is False
    assert found["status"] == ["waiting"] * 8 + ["done"] * 2 + ["running"] + ["waiting"] * 9
    assert [len(row) for row in found["sections"]["values"]] == [0] * 8 + [6, 6, 2] + [0] * 9
    assert found["indicators"]["lyapunov"]["values"][9:11] == [0.9, None]
    assert http.get(f"/v1/jobs/{job}/figures/bifurcation.png").content.startswith(b"\x89PNG")
    claim = worker.start(job, 0)
    worker.compute(claim)
    worker.finish(claim, BlockState.done)
    found = get(http, f"/v1/jobs/{job}/bifurcation", observable=OBSERVED)
    assert found["status"] == ["done"] * 10 + ["running"] + ["waiting"] * 9


@pytest.mark.parametrize("ending", ["cancelled", "failed"])
def test_a_study_that_ended_early_keeps_what_it_has(http, worker, ending):
    job = worker.submit(**BIFURCATION)
    claim = worker.start(job, 0)
    worker.compute(claim, points=3)
    error = JobError("platform", "storage", "The disk is full.")
    if ending == "cancelled":
        http.post(f"/v1/jobs/{job}/cancel")
        worker.finish(claim, BlockState.cancelled)
    else:
        worker.finish(claim, BlockState.failed, error)
    assert get(http, f"/v1/jobs/{job}")["state"] == ending
    found = get(http, f"/v1/jobs/{job}/bifurcation")
    assert found["complete"] is False
    assert found["status"][:4] == ["done", "done", "done", "waiting"]


def test_a_study_cancelled_before_it_began_has_no_results(http, worker):
    job = worker.submit(**SWEEP)
    http.post(f"/v1/jobs/{job}/cancel")
    assert get(http, f"/v1/jobs/{job}/sweep", 404)["type"] == "/problems/no-results"


def test_an_accuracy_study_is_read_as_far_as_it_is_measured(http, worker):
    job = worker.submit(**ACCURACY_STUDY)
    assert get(http, f"/v1/jobs/{job}/accuracy", 409)["type"] == "/problems/results-not-ready"
    worker.compute(worker.start(job), points=4)
    found = get(http, f"/v1/jobs/{job}/accuracy")
    assert (found["complete"], len(found["points"]), found["advice"]) == (False, 2, None)
    assert http.get(f"/v1/jobs/{job}/figures/work-precision.png").is_success
