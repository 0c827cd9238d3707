"""The Python client against the real service."""

import math
import re
import socket

import numpy as np
import pytest

from jointplay.client import (
    ClientError,
    JobCancelled,
    JobFailed,
    NotFound,
    Refused,
    ResultsNotReady,
    ServiceFailure,
    TimedOut,
    Unreachable,
)
from jointplay.records.job import JobError
from jointplay.storage.catalogue.records import BlockState

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


def test_a_submitted_job_can_be_looked_at_listed_and_cancelled(client):
    job = client.submit(PENDULUM | {"label": "from Python", "cache": False})
    assert (job.state, job.label, job.error) == ("queued", "from Python", None)
    assert not job.is_finished
    assert client.job(job.id) == job
    assert {job, client.job(job.id)} == {job}
    assert next(iter(client.jobs())).id == job.id
    assert job.cancel().state == "cancelled"
    assert client.job(job.id).is_finished


def test_jobs_of_several_pages_are_listed_once(connect, fresh_service):
    with connect(fresh_service) as client:
        job = PENDULUM | {"cache": False}
        made = [client.submit(job).id for _ in range(60)]  # more than one page of 50
        assert [job.id for job in client.jobs()] == made[::-1]


def test_a_refused_job_names_every_field(client):
    with pytest.raises(Refused) as caught:
        client.submit(PENDULUM | {"duration": -1.0, "colour": "red"})
    assert caught.value.status == 422
    assert caught.value.problem == "invalid-job"
    assert {field.pointer for field in caught.value.fields} == {"/duration", "/colour"}
    assert "/duration: " in str(caught.value)


def test_a_number_that_json_does_not_know_is_refused_by_the_service(client):
    with pytest.raises(Refused) as caught:
        client.submit(PENDULUM | {"duration": math.inf})
    assert caught.value.fields[0].pointer == "/duration"


@pytest.mark.parametrize("job_id", ["nope", "../scenes", "a/b", "ü\n"])
def test_an_unknown_job_is_not_found(client, job_id):
    with pytest.raises(NotFound):
        client.job(job_id)


def test_waiting_reports_progress_and_returns_the_finished_job(client, worker, capsys):
    job_id = worker.submit()
    seen = []

    def report(job):
        """Play the worker's part one step further at each question."""
        seen.append(job.state)
        if job.state == "queued":
            report.claim = worker.start(job_id)
        elif job.state == "running":
            worker.finish(report.claim, BlockState.done)

    assert client.job(job_id).wait(report=report).state == "succeeded"
    assert seen == ["queued", "running", "succeeded"]
    client.job(job_id).wait(progress=True)
    assert re.fullmatch(r"\S+: 100% t = \S+ s, succeeded\n", capsys.readouterr().err)


def test_waiting_ends_at_its_time_limit_and_leaves_the_job_alone(client, worker):
    job_id = worker.submit()
    with pytest.raises(TimedOut, match="still queued"):
        client.job(job_id).wait(timeout=0.1)
    assert client.job(job_id).state == "queued"


def test_a_failed_job_says_why(client, worker):
    claim = worker.start(worker.submit())
    error = JobError("limit", "step-limit", "Took 10 million steps; loosen the tolerance.")
    worker.finish(claim, BlockState.failed, error)
    with pytest.raises(JobFailed, match="loosen the tolerance") as caught:
        client.job(claim.job.id).wait()
    job = caught.value.job
    assert job.error == error
    assert client.job(claim.job.id).wait(check=False).state == "failed"
    with pytest.raises(JobCancelled):
        client.job(worker.submit()).cancel().wait()


def test_a_window_comes_as_arrays_with_units(client, finished_job):
    window = client.job(finished_job).window(["slider7.x", "A.*"], 0.0, 0.1)
    assert (window.complete, window.exact) == (True, True)
    assert window.time.shape == window["slider7.x"].shape == (101,)
    assert window.channels["slider7.x"].unit == "m"
    assert np.ptp(window["slider7.x"] - window.time) < 1e-12  # stored as column + time


def test_a_window_at_the_resolution_of_a_screen_keeps_the_extremes(client, finished_job):
    window = client.job(finished_job).window("slider7.x", points=10)
    assert not window.exact
    assert len(window.time) <= 20
    low, high = window["slider7.x"].reshape(-1, 2).T
    assert (low <= high).all()
    whole = client.job(finished_job).window("slider7.x")["slider7.x"]
    assert (low.min(), high.max()) == (whole.min(), whole.max())


def test_results_too_large_for_one_answer_come_whole(client, worker):
    job_id = worker.finished(output_step=1e-4)  # 20 001 samples of 96 channels: 2 answers
    history = client.job(job_id).window()
    time = np.linspace(0.0, 2.0, 20_001)
    np.testing.assert_array_equal(history.time, time)
    for column, one in enumerate(history.channels.values()):
        np.testing.assert_array_equal(one.values, column + time)
    with pytest.raises(Refused, match=r"slider7\.vx"):  # other refusals stay what they are
        client.job(job_id).window("slider7.vX")


def test_statistics_hold_the_energy_ledger(client, finished_job):
    assert client.job(finished_job).statistics["energy"]["residual"] == 1e-6


def test_figures_come_as_files(client, finished_job, tmp_path):
    job = client.job(finished_job)
    assert "orbit" in job.figures
    picture = job.figure("orbit", joint="A")
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert picture.save(tmp_path / "orbit").read_bytes() == picture.content
    assert picture.content != job.figure("orbit", joint=["A", "B"]).content
    assert "<svg" in job.figure("slider7.x", form="svg")._repr_svg_()
    saved = job.figure("orbit", title="Centres", width=120).save(tmp_path / "orbit.pdf")
    assert saved.read_bytes().startswith(b"%PDF")  # a suffix says the form
    with pytest.raises(NotFound, match="orbit"):
        job.figure("obrit")
    with pytest.raises(Refused, match="width"):
        job.figure("orbit", width=900.0)
    with pytest.raises(TypeError, match="no option 'colour'"):
        job.figure("orbit", colour="red")


def test_results_of_an_unfinished_job_are_not_ready(client, worker):
    job = client.job(worker.submit())
    for ask in (lambda: job.peaks, lambda: job.history, lambda: job.window("slider7.x")):
        with pytest.raises(ResultsNotReady, match="is queued"):
            ask()


def test_scenes_can_be_fetched_and_run(client):
    names = [scene["name"] for scene in client.scenes()]
    assert "seven-bar-press" in names
    job = client.submit(PENDULUM | {"scene": client.scene("pendulum")})
    assert job.job["scene"]["bodies"]


def test_nobody_there_is_said_clearly(connect):
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    with connect(f"http://127.0.0.1:{port}") as client, pytest.raises(Unreachable) as caught:
        client.job("anything")
    assert f"http://127.0.0.1:{port}" in str(caught.value)
    assert "jointplay serve" in str(caught.value)


@pytest.mark.parametrize("url", ["localhost:8000", "ftp://example.org", "http://[::1", ""])
def test_an_address_that_is_none_is_refused(connect, url):
    with pytest.raises(ClientError, match="is not an address"), connect(url) as client:
        client.job("anything")


def test_another_server_at_the_address_is_a_typed_error_too(connect):
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
            with connect(f"http://127.0.0.1:{server.server_port}") as client:
                with pytest.raises(ServiceFailure, match="502"):
                    client.job("anything")
                with pytest.raises(Refused, match="Forbidden"):
                    client.scenes()
        finally:
            server.shutdown()
            thread.join()
