"""Jobs over HTTP: submit, look at, list, cancel."""

import httpx
import pytest

from jointplay.solver.version import SOLVER_VERSION

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


def test_a_job_is_accepted_with_its_address_and_every_default_filled_in(http):
    answer = http.post("/v1/jobs", json=PENDULUM | {"label": "first", "cache": False})
    assert answer.status_code == 202
    job = answer.json()
    assert job.pop("cached") is False
    assert answer.headers["Location"] == f"/v1/jobs/{job['id']}" == job["links"]["self"]
    assert (job["kind"], job["label"], job["state"]) == ("simulate", "first", "queued")
    assert job["progress"] == {"time": 0.0, "fraction": 0.0, "steps": None}
    assert (job["attempt"], job["started"], job["finished"], job["error"]) == (0, None, None, None)
    assert job["solver_version"] == SOLVER_VERSION
    assert job["job"]["tolerance"] == 1e-6
    assert job["job"]["output_step"] == 1.0 / 2000
    assert job["job"]["scene"]["parameters"]["gravity_y"] == -9.81
    assert http.get(answer.headers["Location"]).json() == job


def test_the_filled_in_job_is_a_job(http):
    first = http.post("/v1/jobs", json=PENDULUM).json()
    again = http.post("/v1/jobs", json=first["job"])
    assert again.status_code == 200
    assert (again.json()["id"], again.json()["cached"]) == (first["id"], True)
    anew = http.post("/v1/jobs", json=first["job"] | {"cache": False})
    assert anew.status_code == 202
    assert anew.json()["job"] == first["job"]
    assert anew.json()["id"] != first["id"]


def test_every_link_of_a_job_leads_somewhere(http, finished_job):
    for name, link in http.get(f"/v1/jobs/{finished_job}").json()["links"].items():
        answer = http.post(link) if name == "cancel" else http.get(link)
        assert answer.is_success, (name, answer.text)


def test_pages_hold_every_job_once_newest_first_while_jobs_arrive(fresh_service):
    with httpx.Client(base_url=fresh_service, trust_env=False, timeout=60) as http:
        job = PENDULUM | {"cache": False}
        made = [http.post("/v1/jobs", json=job).json()["id"] for _ in range(7)]
        listed, token = [], None
        while True:
            query = {"page_size": 3} | ({"page_token": token} if token else {})
            page = http.get("/v1/jobs", params=query).json()
            listed += [job["id"] for job in page["jobs"]]
            http.post("/v1/jobs", json=job)
            token = page["next_page_token"]
            if token is None:
                break
        assert listed == made[::-1]


@pytest.mark.parametrize(
    "query",
    [
        {"page_size": 0},
        {"page_size": 1001},
        {"page_size": "many"},
        {"page_token": "../../etc"},
        {"page_token": ""},
        {"page_token": "%00"},
        {"pagesize": 3},
        {"state": "asleep"},
        {"kind": "simulation"},
        {"label": "x" * 201},
        {"label": "a\0b"},
        {"scene": "\0"},
        {"since": "yesterday"},
        {"since": "2026-01-01T00:00:00"},  # of which time zone?
        {"before": "2026-01-01T00:00:00Z", "since": "2026-01-02T00:00:00Z"},
    ],
)
def test_a_wrong_page_is_refused(http, query):
    answer = http.get("/v1/jobs", params=query)
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["parameter"] == next(iter(query))


def test_cancelling_is_idempotent_and_too_late_changes_nothing(http, worker, finished_job):
    queued = worker.submit()
    for _ in range(2):
        answer = http.post(f"/v1/jobs/{queued}/cancel")
        assert (answer.status_code, answer.json()["state"]) == (202, "cancelled")
    running = worker.submit()
    worker.start(running)
    for _ in range(2):
        answer = http.post(f"/v1/jobs/{running}/cancel")
        assert (answer.status_code, answer.json()["state"]) == (202, "cancelling")
    assert http.post(f"/v1/jobs/{finished_job}/cancel").json()["state"] == "succeeded"


@pytest.mark.parametrize(
    "job_id",
    [
        "00000000000000000000000000",  # well formed, but there is none
        "nope",
        "..%2F..%2Fcatalogue.sqlite",
        "%00",
        "01M7YCD368E9VM5RM0B9JY3SGA%0A",
        "ü",
        "A" * 5000,
    ],
)
@pytest.mark.parametrize("rest", ["", "/history", "/figures/orbit.png"])
def test_an_id_that_is_no_jobs_is_not_found(http, job_id, rest):
    answer = http.get(f"/v1/jobs/{job_id}{rest}")
    assert answer.status_code == 404
    assert answer.headers["Content-Type"] == "application/problem+json"
    assert answer.json()["type"] in {"/problems/unknown-job", "/problems/not-found"}


def test_cancelling_what_is_no_job_is_not_found(http):
    assert http.post("/v1/jobs/nope/cancel").status_code == 404
