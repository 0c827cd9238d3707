"""A run's certificate over HTTP."""

from pathlib import Path
from typing import Any

import httpx
import pytest

from jointplay.local import load
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.settings import Settings
from jointplay.worker.execute import execute
from tests.worker_by_hand import Worker

JOB: dict[str, Any] = {
    "scene": {"preset": "pendulum"},
    "duration": 3.0,
    "channels": ["rod.*"],
    "certificate": True,
}


@pytest.fixture(scope="module")
def computed(http: httpx.Client, worker: Worker, settings: Settings) -> tuple[str, Path]:
    """A job that was really computed, and the folder of its store."""
    job_id = worker.submit(**JOB)
    claim = worker.start(job_id)
    running = settings.running_run(job_id, claim.block.attempt)
    target = settings.sealed_run(job_id, claim.block.attempt)
    admission = admit(claim.job.spec)
    assert isinstance(admission, Admission)
    execute(admission, running.folder, target, report=lambda _: "continue")
    worker.finish(claim, BlockState.done)
    return job_id, settings.data / "results" / target.key


def test_it_says_how_far_the_numbers_can_be_believed(
    http: httpx.Client, computed: tuple[str, Path]
) -> None:
    job_id, folder = computed
    found = http.get(f"/v1/jobs/{job_id}/certificate").json()
    assert found["complete"]
    assert found["converged"] == [[0.0, 3.0]]
    assert found["horizon"] == found["time"]["values"][-1] == 3.0
    assert [lane["complete"] for lane in found["lanes"]] == [True] * 8
    assert found["steps"] == found["lanes"][0]["steps"] > 0
    theta = found["channels"]["rod.theta"]
    assert theta["unit"] == "rad"
    assert len(theta["error"]) == len(found["time"]["values"])
    assert 0.0 < max(theta["error"]) < 1e-3  # tolerance 1e-6, a few swings
    assert sum(theta["histogram"]["share"]) == pytest.approx(1.0)
    assert found == load(folder).certificate


def test_channels_choose(http: httpx.Client, computed: tuple[str, Path]) -> None:
    answer = http.get(f"/v1/jobs/{computed[0]}/certificate?channels=rod.theta")
    assert list(answer.json()["channels"]) == ["rod.theta"]
    assert http.get(f"/v1/jobs/{computed[0]}/certificate?channels=leg.*").status_code == 422


def test_there_is_none_before_the_end_or_where_none_was_asked_for(
    http: httpx.Client, worker: Worker
) -> None:
    job_id = worker.submit(**JOB | {"certificate": False})
    address = f"/v1/jobs/{job_id}/certificate"
    assert http.get(address).status_code == 409
    claim = worker.start(job_id)
    worker.store(claim)
    worker.finish(claim, BlockState.done)
    answer = http.get(address)
    assert answer.status_code == 404
    assert "without a certificate" in answer.json()["detail"]
