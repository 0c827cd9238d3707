"""The Python client against the real service."""

import math
import socket

import numpy as np
import pytest

from jointplay.client import (
    Client,
    ClientError,
    NotFound,
    Refused,
    ResultsNotReady,
    ServiceFailure,
    Unreachable,
)
from storage.catalogue import BlockState, JobError

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


@pytest.fixture(scope="module")
def client(service_url):
    with Client(service_url) as client:
        yield client


def test_a_submitted_job_can_be_looked_at_listed_and_cancelled(client):
    job = client.submit(PENDULUM | {"label": "from Python", "cache": False})
    assert (job.state, job.label, job.error) == ("queued", "from Python", None)
    assert not job.is_finished
    assert client.get(job.id) == job
    assert next(iter(client.jobs())).id == job.id
    assert client.cancel(job.id).state == "cancelled"
    assert client.get(job.id).is_finished


def test_jobs_of_several_pages_are_listed_once(fresh_service):
    with Client(fresh_service) as client:
        job = PENDULUM | {"cache": False}
        made = [client.submit(job).id for _ in range(60)]  # more than one page of 50
        assert [job.id for job in client.jobs()] == made[::-1]


def test_a_refused_job_names_every_field(client):
    with pytest.raises(Refused) as caught:
        client.submit(PENDULUM | {"duration": -1.0, "colour": "red"})
    assert caught.value.status == 422
    assert caught.value.problem == "invalid-job"
    assert {field.place for field in caught.value.fields} == {"/duration", "/colour"}
    assert "/duration: " in str(caught.value)


def test_a_number_that_json_does_not_know_is_refused_by_the_service(client):
    with pytest.raises(Refused) as caught:
        client.submit(PENDULUM | {"duration": math.inf})
    assert caught.value.fields[0].place == "/duration"


@pytest.mark.parametrize("job_id", ["nope", "../scenes", "a/b", "ü\n"])
def test_an_unknown_job_is_not_found(client, job_id):
    with pytest.raises(NotFound):
        client.get(job_id)


def test_waiting_reports_progress_and_returns_the_finished_job(client, worker):
    job_id = worker.submit()
    seen = []

    def report(job):
        """Play the worker's part one step further at each question."""
        seen.append(job.state)
        if job.state == "queued":
            report.claim = worker.start(job_id)
        elif job.state == "running":
            worker.finish(report.claim, BlockState.done)

    assert client.wait(job_id, report).state == "succeeded"
    assert seen == ["queued", "running", "succeeded"]


def test_waiting_ends_at_its_time_limit_and_leaves_the_job_alone(client, worker):
    job_id = worker.submit()
    with pytest.raises(ClientError, match="still queued"):
        client.wait(job_id, timeout=0.1)
    assert client.get(job_id).state == "queued"


def test_a_failed_job_says_why(client, worker):
    claim = worker.start(worker.submit())
    error = JobError("limit", "step-limit", "Took 10 million steps; loosen the tolerance.")
    worker.finish(claim, BlockState.failed, error)
    job = client.wait(claim.job.id)
    assert job.error is not None
    assert (job.error.kind, job.error.detail) == ("limit", error.detail)


def test_results_come_as_arrays_with_units(client, finished_job):
    history = client.history(finished_job, ["slider7.x", "A.*"], start=0.0, stop=0.1)
    assert history.complete
    assert history.time.shape == history["slider7.x"].shape == (101,)
    assert history.channels["slider7.x"].unit == "m"
    assert np.ptp(history["slider7.x"] - history.time) < 1e-12  # stored as column + time
    section = client.poincare(finished_job, ["A.eccentricity_x"])
    assert section.time.tolist() == [0.0, 1.0]
    assert section.note == ""
    peak = client.peaks(finished_job)["slider7.ax"]
    assert (peak.unit, peak.minimum, peak.maximum_time) == ("m/s^2", -1.0, 0.75)
    impacts = client.impacts(finished_job)
    assert impacts.joint == ["B"]
    assert np.isnan(impacts.release).all()


def test_results_too_large_for_one_answer_come_whole(client, worker):
    job_id = worker.finished(output_step=1e-4)  # 20 001 samples of 95 channels: 2 answers
    history = client.history(job_id)
    time = np.linspace(0.0, 2.0, 20_001)
    np.testing.assert_array_equal(history.time, time)
    for column, one in enumerate(history.channels.values()):
        np.testing.assert_array_equal(one.values, column + time)
    with pytest.raises(Refused, match=r"slider7\.vx"):  # other refusals stay what they are
        client.history(job_id, ["slider7.vX"])


def test_sections_and_impacts_of_a_window_can_be_asked_for(client, finished_job):
    assert client.poincare(finished_job, ["A.force_x"], start=0.5).time.tolist() == [1.0]
    assert client.impacts(finished_job, start=0.5, stop=0.5).onset.tolist() == [0.5]
    assert client.impacts(finished_job, stop=0.4).joint == []


def test_statistics_hold_the_energy_ledger(client, finished_job):
    assert client.statistics(finished_job)["energy"]["residual"] == 1e-6


def test_figures_come_as_files(client, finished_job):
    names = client.figures(finished_job)
    assert "orbit" in names
    assert client.figure(finished_job, "orbit").startswith(b"\x89PNG")
    assert b"<svg" in client.figure(finished_job, "slider7.x", "svg")
    with pytest.raises(NotFound, match="orbit"):
        client.figure(finished_job, "obrit")


def test_results_of_an_unfinished_job_are_not_ready(client, worker):
    with pytest.raises(ResultsNotReady, match="is queued"):
        client.peaks(worker.submit())


def test_scenes_can_be_fetched_and_run(client):
    names = [scene["name"] for scene in client.scenes()]
    assert "seven-bar-press" in names
    job = client.submit(PENDULUM | {"scene": client.scene("pendulum")})
    assert job.job["scene"]["bodies"]


def test_nobody_there_is_said_clearly():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    with Client(f"http://127.0.0.1:{port}") as client, pytest.raises(Unreachable) as caught:
        client.get("anything")
    assert f"http://127.0.0.1:{port}" in str(caught.value)
    assert "jointplay serve" in str(caught.value)


@pytest.mark.parametrize("url", ["localhost:8000", "ftp://example.org", "http://[::1", ""])
def test_an_address_that_is_none_is_refused(url):
    with pytest.raises(ClientError, match="is not an address"), Client(url) as client:
        client.get("anything")


def test_another_server_at_the_address_is_a_typed_error_too():
    """A proxy or a foreign program answers without problem documents."""
    import threading
    from http.server import BaseHTTPRequestHandler, HTTPServer

    class Foreign(BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_error(502 if "jobs" in self.path else 403)

        def log_message(self, *arguments):
            pass

    with HTTPServer(("127.0.0.1", 0), Foreign) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            with Client(f"http://127.0.0.1:{server.server_port}") as client:
                with pytest.raises(ServiceFailure, match="502"):
                    client.get("anything")
                with pytest.raises(Refused, match="Forbidden"):
                    client.scenes()
        finally:
            server.shutdown()
            thread.join()
