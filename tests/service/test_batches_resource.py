"""Batches over HTTP: all jobs or none, looked at, listed and cancelled as one."""

from typing import Any

import httpx
import pytest

from jointplay.records.job import JobError
from jointplay.service.batches.admission import MOST_JOBS
from jointplay.service.body import LARGEST_BATCH
from jointplay.storage.catalogue.records import BlockState
from tests.worker_by_hand import BIFURCATION

PENDULUM: dict[str, Any] = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
DIAGRAM: dict[str, Any] = {"scene": {"preset": "seven-bar-press"}, **BIFURCATION}


def submitted(http: httpx.Client, jobs: list[Any], **fields: Any) -> dict[str, Any]:
    answer = http.post("/v1/batches", json={"jobs": jobs, **fields})
    assert answer.status_code == 202, answer.text
    batch: dict[str, Any] = answer.json()
    assert answer.headers["Location"] == batch["links"]["self"] == f"/v1/batches/{batch['id']}"
    return batch


def test_a_batch_queues_jobs_of_all_kinds_in_order(http):
    batch = submitted(http, [PENDULUM, DIAGRAM, PENDULUM | {"label": "third"}], label="mixed")
    assert (batch["label"], batch["jobs"], batch["finished"]) == ("mixed", 3, False)
    assert batch["states"]["queued"] == 3
    assert batch["progress"] == {"fraction": 0.0}
    shown = http.get(batch["links"]["self"]).json()
    assert shown == {name: value for name, value in batch.items() if name != "job_ids"}
    jobs = http.get(batch["links"]["jobs"]).json()["jobs"]
    assert [job["id"] for job in jobs] == batch["job_ids"]
    assert [job["kind"] for job in jobs] == ["simulate", "bifurcation", "simulate"]
    assert {job["batch"] for job in jobs} == {batch["id"]}
    assert {job["links"]["batch"] for job in jobs} == {batch["links"]["self"]}
    assert jobs[2]["label"] == "third"
    assert http.get(f"/v1/jobs/{batch['job_ids'][1]}").json() == jobs[1]


def test_jobs_of_a_batch_come_in_pages_without_those_of_others(http):
    batch = submitted(http, [PENDULUM] * 7)
    http.post("/v1/jobs", json=PENDULUM)
    listed, token = [], None
    while True:
        query = {"page_size": 3} | ({"page_token": token} if token else {})
        page = http.get(batch["links"]["jobs"], params=query).json()
        listed += [job["id"] for job in page["jobs"]]
        token = page["next_page_token"]
        if token is None:
            break
    assert listed == batch["job_ids"]
    wrong = http.get(batch["links"]["jobs"], params={"page_token": "x"})
    assert (wrong.status_code, wrong.json()["errors"][0]["parameter"]) == (422, "page_token")


def test_one_bad_job_is_named_by_its_index_and_nothing_is_queued(http):
    before = http.get("/v1/jobs").json()["jobs"]
    jobs = [PENDULUM] * 17 + [PENDULUM | {"duration": -1.0}, PENDULUM, {"kind": "simulation"}]
    answer = http.post("/v1/batches", json={"jobs": jobs})
    assert answer.status_code == 422
    problem = answer.json()
    assert problem["type"] == "/problems/invalid-job"
    pointers = [error["pointer"] for error in problem["errors"]]
    assert pointers[0] == "/jobs/17/duration"
    assert all(pointer.startswith("/jobs/19/") for pointer in pointers[1:])
    assert http.get("/v1/jobs").json()["jobs"] == before


@pytest.mark.parametrize(
    ("document", "pointer"),
    [
        ([], ""),
        ({}, "/jobs"),
        ({"jobs": []}, "/jobs"),
        ({"jobs": {"0": PENDULUM}}, "/jobs"),
        ({"jobs": [7]}, "/jobs/0"),
        ({"jobs": [PENDULUM], "label": 7}, "/label"),
        ({"jobs": [PENDULUM], "label": "x" * 201}, "/label"),
        ({"jobs": [PENDULUM], "colour": "red"}, "/colour"),
    ],
)
def test_a_batch_that_is_none_is_refused_with_the_place(http, document, pointer):
    answer = http.post("/v1/batches", json=document)
    assert answer.status_code == 422, answer.text
    assert answer.json()["errors"][0]["pointer"] == pointer


def test_too_many_jobs_are_a_limit(http):
    answer = http.post("/v1/batches", json={"jobs": [7] * (MOST_JOBS + 1)})
    assert answer.status_code == 422
    assert answer.json()["type"] == "/problems/limit-exceeded"
    assert str(MOST_JOBS) in answer.json()["detail"]


def test_a_body_that_is_too_large_is_not_read(http):
    answer = http.post(
        "/v1/batches",
        content=b" " * (LARGEST_BATCH + 1),
        headers={"Content-Type": "application/json"},
    )
    assert answer.status_code == 413


def test_a_batch_shows_the_progress_of_the_whole(http, worker, catalogue):
    press = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
    batch = submitted(http, [press] * 4)
    first, second, third, _ = batch["job_ids"]
    claim = worker.start(first)
    worker.store(claim)
    worker.finish(claim, BlockState.done)
    claim = worker.start(second)
    worker.store_nothing(claim)
    worker.finish(claim, BlockState.failed, JobError("solver", "step-size-underflow", "No step."))
    claim = worker.start(third)
    catalogue.record_progress(claim.block.id, claim.block.attempt, 60.0, time=1.0, fraction=0.5)
    shown = http.get(batch["links"]["self"]).json()
    counts = {state: count for state, count in shown["states"].items() if count}
    assert counts == {"succeeded": 1, "failed": 1, "running": 1, "queued": 1}
    assert shown["progress"]["fraction"] >= 0.375
    assert shown["finished"] is False


def test_cancelling_a_batch_cancels_what_is_not_finished(http, worker):
    batch = submitted(http, [PENDULUM] * 3)
    worker.start(batch["job_ids"][0])
    for _ in range(2):
        answer = http.post(batch["links"]["cancel"])
        assert answer.status_code == 202
        counts = {state: count for state, count in answer.json()["states"].items() if count}
        assert counts == {"cancelling": 1, "cancelled": 2}


@pytest.mark.parametrize("batch_id", ["0" * 26, "nope", "%00", "A" * 5000])
@pytest.mark.parametrize("rest", ["", "/jobs"])
def test_an_id_that_is_no_batchs_is_not_found(http, batch_id, rest):
    answer = http.get(f"/v1/batches/{batch_id}{rest}")
    assert answer.status_code == 404
    assert answer.json()["type"] == "/problems/unknown-batch"
