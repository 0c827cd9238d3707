"""Batches over HTTP: all jobs or none, looked at, listed and cancelled as one."""

from typing import Any

import httpx
import pytest

from jointplay.records import strict_json
from jointplay.records.job import JobError
from jointplay.service.batches import admission
from jointplay.service.batches.admission import MOST_JOBS
from jointplay.service.body import LARGEST_BATCH
from jointplay.storage.catalogue.catalogue import Catalogue
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


def ended_otherwise(worker: Any, batch: dict[str, Any]) -> None:
    """Have the first job succeed, the second fail, and the third be cancelled."""
    done, failed, cancelled = batch["job_ids"]
    worker.finish(worker.start(done), BlockState.done)
    error = JobError("platform", "worker-lost", "Lost.")
    worker.finish(worker.start(failed), BlockState.failed, error)
    worker._http.post(f"/v1/jobs/{cancelled}/cancel").raise_for_status()


def test_a_retry_of_a_batch_is_a_batch_of_what_failed_or_was_cancelled(http, worker):
    batch = submitted(http, [PENDULUM | {"label": name} for name in "abc"], label="three")
    assert http.post(batch["links"]["retry"]).json()["type"] == "/problems/nothing-to-retry"
    ended_otherwise(worker, batch)
    answer = http.post(batch["links"]["retry"])
    assert answer.status_code == 202, answer.text
    retry = answer.json()
    assert answer.headers["Location"] == retry["links"]["self"]
    assert (retry["label"], retry["jobs"], retry["states"]["queued"]) == ("three", 2, 2)
    jobs = http.get(retry["links"]["jobs"]).json()["jobs"]
    assert [job["label"] for job in jobs] == ["b", "c"]
    assert http.post(batch["links"]["retry"]).json() == retry, "asked again, it is the same"
    assert http.get(batch["links"]["self"]).json()["states"]["failed"] == 1
    events = http.get(f"/v1/jobs/{batch['job_ids'][1]}/events").text
    assert '"type":"retried"' in events
    assert f'"data":{{"job":"{retry["job_ids"][0]}"}}' in events
    # what failed later is retried without what was
    worker.finish(worker.start(retry["job_ids"][0]), BlockState.done)
    more = submitted(http, [PENDULUM] * 3)
    ended_otherwise(worker, more)
    one = http.post(f"/v1/jobs/{more['job_ids'][1]}/retry").json()["id"]
    (other,) = http.post(more["links"]["retry"]).json()["job_ids"]
    assert one == more["job_ids"][0], "which has computed the same"
    assert one != other
    assert f'"job":"{other}"' in http.get(f"/v1/jobs/{more['job_ids'][2]}/events").text


def test_a_retry_that_another_one_overtakes_is_asked_for_again(http, worker, monkeypatch):
    batch = submitted(http, [PENDULUM | {"duration": 0.3 + 0.1 * k} for k in range(2)])
    first, second = batch["job_ids"]
    http.post(f"/v1/jobs/{first}/cancel").raise_for_status()
    look, overtaken = Catalogue.unsuccessful, []

    def overtaking(catalogue, name):
        found = look(catalogue, name)
        if not overtaken:
            overtaken.append(name)
            http.post(f"/v1/jobs/{second}/cancel").raise_for_status()
            overtaken.append(http.post(batch["links"]["retry"]).json())
        return found

    monkeypatch.setattr(Catalogue, "unsuccessful", overtaking)
    answer = http.post(batch["links"]["retry"])
    assert (answer.status_code, answer.headers["Retry-After"]) == (503, "1")
    assert f"A retry of job {first} was queued meanwhile" in answer.json()["detail"]
    assert http.post(batch["links"]["retry"]).json() == overtaken[1]
    assert overtaken[1]["jobs"] == 2


def test_a_retry_of_a_job_is_one_job_however_often_it_is_asked_for(http, worker):
    job = worker.submit(label="to be retried", duration=0.7)
    path = f"/v1/jobs/{job}/retry"
    refused = http.post(path)
    assert (refused.status_code, refused.json()["type"]) == (409, "/problems/nothing-to-retry")
    assert "queued" in refused.json()["detail"]
    http.post(f"/v1/jobs/{job}/cancel").raise_for_status()
    first = http.post(path)
    assert first.status_code == 202
    new = first.json()
    assert first.headers["Location"] == new["links"]["self"] != f"/v1/jobs/{job}"
    assert (new["label"], new["cached"], new["state"]) == ("to be retried", False, "queued")
    again = http.post(path)
    assert (again.status_code, again.json()["id"], again.json()["cached"]) == (200, new["id"], True)
    http.post(f"{new['links']['self']}/cancel").raise_for_status()
    assert http.post(path).json()["id"] not in (job, new["id"]), "the retry was cancelled itself"
    assert http.get(f"/v1/jobs/{job}").json()["state"] == "cancelled"


def test_a_batch_is_deleted_with_its_jobs(http, worker):
    batch = submitted(http, [PENDULUM] * 3)
    path = batch["links"]["self"]
    refused = http.delete(path)
    assert (refused.status_code, refused.json()["type"]) == (409, "/problems/not-finished")
    assert "3 jobs have not ended" in refused.json()["detail"]
    ended_otherwise(worker, batch)
    deleted = http.delete(path)
    assert (deleted.status_code, deleted.json()["id"]) == (200, batch["id"])
    for address in (path, batch["links"]["jobs"]):
        assert http.get(address).status_code == 404
    assert http.delete(path).status_code == 404
    for job in batch["job_ids"]:
        assert http.get(f"/v1/jobs/{job}").status_code == 410


@pytest.mark.parametrize("size", [2, 200])
def test_a_batch_that_is_sent_again_is_found_before_its_jobs_are_checked(
    application, http, monkeypatch, size
):
    checked = []
    document = {"jobs": [PENDULUM | {"label": "x" * 180}] * size}
    headers = {"Idempotency-Key": f"sent twice {size}".replace(" ", "-")}
    first = http.post("/v1/batches", json=document, headers=headers).json()
    process = application.state.checker._others
    process.close()
    checks = admission.checked
    monkeypatch.setattr(admission, "checked", lambda *of: checked.append(of) or checks(*of))
    parsed, loads = [], strict_json._loads
    monkeypatch.setattr(strict_json, "_loads", lambda text: parsed.append(text) or loads(text))
    again = http.post("/v1/batches", json=document, headers=headers)
    assert (again.status_code, again.json()) == (202, first)
    assert not checked
    assert not parsed, "to read it may take seconds"
    assert not process.running(), "no other process was asked"
    other = http.post("/v1/batches", json={"jobs": [PENDULUM]}, headers=headers)
    assert (other.status_code, other.json()["type"]) == (422, "/problems/key-reused")
    headers = {"Idempotency-Key": f"another-{size}"}
    assert http.post("/v1/batches", json=document, headers=headers).json()["id"] != first["id"]
    assert len(checked) == (2 if size == 2 else 0)


def test_a_batch_whose_failed_jobs_were_deleted_is_said_to_have_none_left(http):
    batch = http.post("/v1/batches", json={"jobs": [PENDULUM | {"cache": False}]}).json()
    http.post(batch["links"]["cancel"]).raise_for_status()
    (job,) = batch["job_ids"]
    http.delete(f"/v1/jobs/{job}").raise_for_status()
    detail = http.post(batch["links"]["retry"]).json()["detail"]
    assert detail.endswith("all that failed or were cancelled were deleted or expired.")
