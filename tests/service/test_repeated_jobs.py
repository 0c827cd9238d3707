"""Jobs that are asked for again: identical ones, repeated requests, expired and deleted ones."""

import math
import threading
from contextlib import closing, contextmanager
from datetime import UTC, datetime, timedelta

import httpx
import pytest
from sqlalchemy import update

from jointplay.records.failure import InvalidInput
from jointplay.records.job import JobError
from jointplay.service import checking
from jointplay.service.app import create_app
from jointplay.service.batches.admission import QueueBatch
from jointplay.service.checking import CheckJob, RepeatJob
from jointplay.service.idempotency import SentKey
from jointplay.service.jobs.submission import checked
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.connections import Connections
from jointplay.storage.catalogue.errors import Interrupted
from jointplay.storage.catalogue.quotas import NO_QUOTA
from jointplay.storage.catalogue.records import BlockEnd, BlockState
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving
from tests.waiting import until

SCENE = {"preset": "slider-crank", "parameters": {"clearance": 1.25e-4}}
JOB = {"kind": "simulate", "scene": SCENE, "duration": 0.125}


@pytest.fixture
def own(tmp_path):
    """A service and a catalogue of its own."""
    settings = Settings(data=tmp_path / "data")
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        catalogue = Catalogue(settings.catalogue_url)
        yield http, catalogue
        catalogue.close()


def test_an_identical_job_is_the_one_that_is_there(own):
    http, _ = own
    first = http.post("/v1/jobs", json=JOB | {"label": "first"})
    assert (first.status_code, first.json()["cached"]) == (202, False)
    same = [
        JOB | {"label": "second"},
        JOB | {"output_step": 0.125 / 2000, "tolerance": 1e-6},  # the defaults, written out
        JOB | {"accuracy": "standard"},
    ]
    for job in same:
        again = http.post("/v1/jobs", json=job)
        assert (again.status_code, again.json()["cached"]) == (200, True)
        assert (again.json()["id"], again.json()["label"]) == (first.json()["id"], "first")
        assert again.headers["Location"] == first.headers["Location"]
    for other in (JOB | {"cache": False}, JOB | {"tolerance": 1e-7}, JOB | {"channels": ["P.*"]}):
        assert http.post("/v1/jobs", json=other).status_code == 202


def test_what_accuracy_costs_is_measured_again_only_if_asked_for(own):
    """Errors, steps and evaluations would be the same; seconds are those of the machine."""
    http, _ = own
    study = {"kind": "accuracy-study", "scene": SCENE, "methods": ["rk4"]}
    first = http.post("/v1/jobs", json=study)
    again = http.post("/v1/jobs", json=study)
    assert (again.status_code, again.json()["id"]) == (200, first.json()["id"])
    assert http.post("/v1/jobs", json=study | {"cache": False}).status_code == 202


@pytest.mark.parametrize("ending", ["failed", "cancelled"])
def test_a_job_that_ended_badly_is_computed_again(own, ending):
    http, catalogue = own
    first = http.post("/v1/jobs", json=JOB).json()["id"]
    if ending == "cancelled":
        http.post(f"/v1/jobs/{first}/cancel")
    else:
        catalogue.claim_block(f"{first}-0", "test", 60)
        catalogue.finish(
            f"{first}-0", 1, BlockEnd(BlockState.failed, JobError("platform", "x", "X."))
        )
    assert http.post("/v1/jobs", json=JOB).status_code == 202


def test_a_request_with_two_keys_is_refused(own):
    http, _ = own
    keys = [("Idempotency-Key", "one"), ("Idempotency-Key", "other")]
    refused = http.post("/v1/jobs", json=JOB, headers=keys)
    assert (refused.status_code, refused.json()["errors"]) == (
        422,
        [
            {
                "parameter": "Idempotency-Key",
                "detail": "This header is there more than once; a request has one key.",
            }
        ],
    )
    assert http.get("/v1/jobs").json()["jobs"] == []


def test_a_repeated_request_finds_what_the_first_one_made(own):
    http, _ = own
    key = {"Idempotency-Key": "A-Key"}
    job = JOB | {"cache": False}
    first, again = (http.post("/v1/jobs", json=job, headers=key) for _ in range(2))
    assert (first.status_code, again.status_code) == (202, 202)
    assert again.json() == first.json()
    other = http.post("/v1/jobs", json=job | {"duration": 0.25}, headers=key)
    assert (other.status_code, other.json()["type"]) == (422, "/problems/key-reused")
    assert other.json()["errors"][0]["parameter"] == "Idempotency-Key"
    assert other.json()["detail"].startswith("The idempotency key 'A-Key' was used")
    assert len(http.get("/v1/jobs").json()["jobs"]) == 1
    batch = http.post("/v1/batches", json={"jobs": [job]}, headers=key)
    assert batch.json()["type"] == "/problems/key-reused"


@pytest.mark.parametrize("points", [2, 2000])
def test_a_job_that_is_sent_again_is_found_before_it_is_checked(tmp_path, monkeypatch, points):
    counted = []
    values = [4.0 + 1e-4 * math.pi * i for i in range(points)]
    study = {"kind": "bifurcation", "scene": {"preset": "driven-pendulum"}, "parameter": "speed"}
    study |= {"values": values, "settle": 1, "record": 1}
    headers = {"Idempotency-Key": "a-study"}
    app = create_app(Settings(data=tmp_path / "data"))
    with serving(app) as url, httpx.Client(base_url=url, trust_env=False, timeout=300) as http:
        first = http.post("/v1/jobs", json=study, headers=headers)
        assert first.status_code == 202
        process = app.state.checker._jobs
        process.close()
        monkeypatch.setattr(checking, "checked", lambda *of: counted.append(of) or checked(*of))
        again = http.post("/v1/jobs", json=study, headers=headers)
        assert (again.status_code, again.json()) == (202, first.json())
        assert not counted
        assert not process.running(), "no other process was asked"
        other = http.post("/v1/jobs", json=study | {"record": 2}, headers=headers)
        assert (other.status_code, other.json()["type"]) == (422, "/problems/key-reused")
        headers = {"Idempotency-Key": "another"}
        cached = http.post("/v1/jobs", json=study, headers=headers).json()
        assert (cached["id"], cached["cached"]) == (first.json()["id"], True)
        again = http.post("/v1/jobs", json=study, headers=headers).json()
        assert (again["id"], again["cached"]) == (first.json()["id"], True)
        assert len(counted) == (1 if points == 2 else 0)


def test_axes_in_another_order_are_another_request(own):
    http, _ = own
    key, grid = {"Idempotency-Key": "k"}, {"clearance": [1e-4, 2e-4], "friction": [0.0, 0.1]}
    sweep = {"kind": "sweep", "scene": {"preset": "slider-crank"}, "periods": 1}
    one, other = (sweep | {"grid": axes} for axes in (grid, dict(reversed(grid.items()))))
    first = http.post("/v1/jobs", json=one, headers=key)
    assert first.status_code == 202
    again = http.post("/v1/jobs", json=other, headers=key)
    assert (again.status_code, again.json()["type"]) == (422, "/problems/key-reused")
    batches = [
        http.post("/v1/batches", json={"jobs": [job]}, headers=key | {"Idempotency-Key": "b"})
        for job in (one, other)
    ]
    assert [batch.status_code for batch in batches] == [202, 422]
    assert http.post("/v1/jobs", json=other).json()["id"] != first.json()["id"]


def test_a_repeated_batch_finds_the_first_one(own):
    http, _ = own
    key = {"Idempotency-Key": "k"}
    first, again = (
        http.post("/v1/batches", json={"jobs": [JOB, JOB]}, headers=key) for _ in range(2)
    )
    assert again.json() == first.json()
    assert len(set(first.json()["job_ids"])) == 2


def test_a_key_is_free_again_after_a_refused_request(own):
    http, _ = own
    key = {"Idempotency-Key": "k"}
    assert http.post("/v1/jobs", json=JOB | {"duration": -1}, headers=key).status_code == 422
    assert http.post("/v1/jobs", json=JOB, headers=key).status_code == 202


def test_a_key_in_flight_is_answered_before_the_document_is_checked(tmp_path):
    app = create_app(Settings(data=tmp_path / "data"))
    with serving(app) as url, httpx.Client(base_url=url, trust_env=False) as http:
        for path, wrong in (("/v1/jobs", JOB | {"duration": -1}), ("/v1/batches", {"jobs": [7]})):
            headers = {"Idempotency-Key": path}
            http.get("/healthz")  # it has begun
            app.state.in_flight["", path] = "another request"
            busy = http.post(path, json=wrong, headers=headers)
            assert (busy.status_code, busy.headers["Retry-After"]) == (409, "1")
            del app.state.in_flight["", path]
            assert http.post(path, json=wrong, headers=headers).status_code == 422
        assert app.state.in_flight == {}


def test_of_requests_at_the_same_time_with_one_key_one_makes_a_job(own):
    http, _ = own
    answers = []
    study = {"kind": "bifurcation", "scene": {"preset": "slider-crank"}, "parameter": "clearance"}
    study |= {"values": {"from": 1e-4, "to": 5e-4, "count": 500}, "cache": False}

    def post():
        answer = httpx.post(
            f"{http.base_url}/v1/jobs",
            json=study,
            headers={"Idempotency-Key": "same"},
            timeout=60,
            trust_env=False,
        )
        answers.append((answer.status_code, answer.headers.get("Retry-After")))

    threads = [threading.Thread(target=post) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert set(answers) <= {(202, None), (409, "1")}
    assert (202, None) in answers
    assert len(http.get("/v1/jobs").json()["jobs"]) == 1


@pytest.mark.parametrize("key", ["", "x" * 256, "with a space", "tab\tbed"])
def test_a_key_that_is_none_is_refused(http, key):
    answer = http.post("/v1/jobs", json=JOB, headers={"Idempotency-Key": key})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["parameter"] == "Idempotency-Key"


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("cache", 1),
        ("cache", "false"),
        ("cache", None),
        ("expires", "tomorrow"),
        ("expires", 1e10),
        ("expires", "2001-01-01T00:00:00Z"),
        ("expires", "2101-01-01T00:00:00"),  # of which time zone?
        ("expires", "9999-12-31T23:59:59-12:00"),  # which is in the year 10000
    ],
)
def test_wrong_wishes_are_refused_together_with_a_wrong_job(http, field, value):
    answer = http.post("/v1/jobs", json=JOB | {field: value, "duration": -1.0})
    assert answer.status_code == 422
    assert {one["pointer"] for one in answer.json()["errors"]} == {f"/{field}", "/duration"}
    assert http.post("/v1/jobs", json=JOB | {field: value}).status_code == 422


def test_a_job_may_expire_at_the_last_moment_that_there_is(own):
    http, _ = own
    job = http.post("/v1/jobs", json=JOB | {"expires": "9999-12-31T23:59:59Z"}).json()
    assert job["expires"] == "9999-12-31T23:59:59Z"


def test_lists_show_a_job_that_expires_when_no_date_can_say(own):
    http, catalogue = own
    job = http.post("/v1/jobs", json=JOB).json()["id"]
    with catalogue.connections.writing(durable=True) as connection:  # as earlier versions could
        connection.execute(update(tables.job).values(expires=1e12))
    (listed,) = http.get("/v1/jobs").json()["jobs"]
    assert (listed["id"], listed["expires"]) == (job, "9999-12-31T23:59:59Z")
    assert http.post(f"/v1/jobs/{job}/cancel").status_code == 202


def test_an_expired_job_is_gone(own):
    http, catalogue = own
    soon = (datetime.now(UTC) + timedelta(seconds=0.7)).isoformat()
    job = http.post("/v1/jobs", json=JOB | {"expires": soon}).json()
    assert datetime.fromisoformat(job["expires"]) == datetime.fromisoformat(soon)
    assert "expires" not in job["job"]
    address = f"/v1/jobs/{job['id']}"
    catalogue.claim_block(f"{job['id']}-0", "test", 60)
    assert http.get(address, params={"wait": 1}).json()["state"] == "running"
    assert http.get(address).status_code == 200  # what is being computed does not expire
    catalogue.finish(f"{job['id']}-0", 1, BlockEnd(BlockState.done))
    ended = catalogue.get(job["id"])
    assert 0.0 < ended.expires - ended.finished <= 0.7  # as long as from its submission on
    until(lambda: http.get(address).status_code == 410)
    for path in ("", "/peaks", "/events", "/figures/orbit.png"):
        answer = http.get(address + path)
        assert (answer.status_code, answer.json()["type"]) == (410, "/problems/expired-job")
    assert http.get("/v1/jobs").json()["jobs"] == []
    assert http.post("/v1/jobs", json=JOB).status_code == 202


def test_a_job_is_deleted_once_it_is_finished(own):
    http, catalogue = own
    job_id = http.post("/v1/jobs", json=JOB).json()["id"]
    refused = http.delete(f"/v1/jobs/{job_id}")
    assert (refused.status_code, refused.json()["type"]) == (409, "/problems/not-finished")
    assert job_id in refused.json()["detail"]
    catalogue.claim_block(f"{job_id}-0", "test", 60)
    catalogue.finish(f"{job_id}-0", 1, BlockEnd(BlockState.done))
    assert http.delete(f"/v1/jobs/{job_id}").json()["expires"] is not None
    assert http.delete(f"/v1/jobs/{job_id}").status_code == 410
    assert http.get(f"/v1/jobs/{job_id}").status_code == 410
    assert catalogue.removable(10) == (job_id,)
    assert http.delete("/v1/jobs/nope").status_code == 404


def test_jobs_expire_by_themselves_where_the_service_says_so(tmp_path):
    settings = Settings(data=tmp_path / "data", keep=3600)
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        job = http.post("/v1/jobs", json=JOB).json()
        created, expires = (datetime.fromisoformat(job[name]) for name in ("created", "expires"))
        assert abs((expires - created).total_seconds() - 3600) < 5
        kept = http.post("/v1/jobs", json=JOB | {"expires": "2999-01-01T00:00:00Z"}).json()
        assert (kept["id"], kept["expires"]) == (job["id"], "2999-01-01T00:00:00Z")


def test_what_is_retried_is_kept_for_as_long_as_was_asked_for(own):
    http, _ = own
    soon = (datetime.now(UTC) + timedelta(seconds=1000)).isoformat()
    expiring, lasting = JOB | {"expires": soon}, JOB | {"duration": 0.5}
    jobs = [http.post("/v1/jobs", json=one).json()["id"] for one in (expiring, lasting)]
    batch = http.post("/v1/batches", json={"jobs": [expiring, lasting]}).json()
    for job in (*jobs, *batch["job_ids"]):
        http.post(f"/v1/jobs/{job}/cancel")
    again = [http.post(f"/v1/jobs/{job}/retry").json()["id"] for job in jobs]
    again += http.post(f"/v1/batches/{batch['id']}/retry").json()["job_ids"]
    assert not {*again} & {*jobs, *batch["job_ids"]}
    for at, job in enumerate(http.get(f"/v1/jobs/{one}").json() for one in again):
        if at % 2:
            assert job["expires"] is None
        else:
            ends = datetime.fromisoformat(job["expires"]) - datetime.fromisoformat(job["created"])
            assert ends.total_seconds() == pytest.approx(1000, abs=60)


def test_jobs_are_listed_by_what_they_are(own):
    http, _ = own
    made = {}
    for name, job in (
        ("slider", JOB | {"label": "a"}),
        ("pendulum", {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}),
        ("poincare", {"kind": "poincare", "scene": SCENE, "settle": 1, "record": 2, "label": "b"}),
    ):
        made[name] = http.post("/v1/jobs", json=job).json()
    http.post(f"/v1/jobs/{made['pendulum']['id']}/cancel")

    def listed(**query):
        jobs = http.get("/v1/jobs", params=query).json()["jobs"]
        return [next(name for name in made if made[name]["id"] == job["id"]) for job in jobs]

    assert listed() == ["poincare", "pendulum", "slider"]
    assert listed(state="cancelled") == ["pendulum"]
    assert listed(kind="simulate") == ["pendulum", "slider"]
    assert listed(scene="slider-crank") == ["poincare", "slider"]
    assert listed(scene="slider-crank", label="b") == ["poincare"]
    assert listed(label="c") == []
    moment = made["pendulum"]["created"]
    assert listed(since=moment) == ["poincare", "pendulum"]
    assert listed(before=moment) == ["slider"]
    assert listed(since="0001-01-01T00:00:00Z", before="9999-12-31T23:59:59Z") == listed()


@pytest.mark.parametrize("document", [JOB, JOB | {"cache": False}])
def test_a_job_is_made_once_where_the_answer_to_its_commit_is_lost(own, monkeypatch, document):
    """The unit is begun anew, and must find what it has done."""
    http, catalogue = own
    http.get("/healthz")  # it has begun
    lost = []
    writing = Connections.writing

    @contextmanager
    def losing(connections, *, durable=False):
        with writing(connections, durable=durable) as connection:
            yield connection
        if durable and not lost:
            lost.append(durable)
            raise Interrupted("does not answer")

    monkeypatch.setattr(Connections, "writing", losing)
    answer = http.post("/v1/jobs", json=document)
    assert lost
    (job,) = catalogue.jobs().jobs
    assert answer.json()["id"] == job.id


def test_jobs_expire_by_the_clock_of_the_catalogue(tmp_path):
    """That of an API's machine may be hours behind: all of its jobs would have expired."""
    settings, moment = Settings(data=tmp_path, keep=3600.0), 4e9
    with closing(Catalogue(settings.catalogue_url, clock=lambda: moment)) as catalogue:
        catalogue.migrate()
        assert CheckJob()(dict(JOB), settings, catalogue).job.expires == moment + 3600.0
        stored = CheckJob()(dict(JOB), settings, catalogue).job.spec
        assert RepeatJob()(stored, settings, catalogue).expires == moment + 3600.0
        queue = QueueBatch(SentKey.made_here("").with_body(), "", NO_QUOTA)
        (queued,) = queue({"jobs": [dict(JOB)]}, settings, catalogue).jobs
        assert catalogue.get(queued).expires == moment + 3600.0
        past = JOB | {"expires": datetime.fromtimestamp(moment - 1.0, UTC).isoformat()}
        with pytest.raises(InvalidInput, match="a moment to come"):
            CheckJob()(past, settings, catalogue)
