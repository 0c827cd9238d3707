"""Following a job by its events, over connections that break; what else clients ask of jobs."""

import time
import uuid
from datetime import UTC, datetime, timedelta
from random import uniform

import pytest

from jointplay.client import Expired, NotFinished, Refused, TimedOut, Unreachable, service_job
from jointplay.client.connection import Connection
from jointplay.service import owners
from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


def test_a_job_is_reported_whenever_it_has_changed(client, worker, catalogue):
    job_id = worker.submit()
    seen = []

    def report(job):
        seen.append((job.state, job.progress.fraction, job.progress.steps))
        if job.state == "queued":
            report.claim = worker.start(job_id)
        elif job.progress.fraction == 0.0:
            block = report.claim.block.id
            catalogue.record_progress(block, 1, 60.0, time=1.0, fraction=0.5, steps=700)
        elif not job.is_finished:
            worker.finish(report.claim, BlockState.done)

    job = client.job(job_id).wait(report=report)
    assert seen == [
        ("queued", 0.0, None),
        ("running", 0.0, None),
        ("running", 0.5, 700),
        ("succeeded", 1.0, 700),
    ]
    assert job.finished is not None


def test_a_job_whose_events_are_not_streamed_is_waited_for_all_the_same(
    client, worker, monkeypatch
):
    """As one of more jobs than an owner may have streams of."""
    monkeypatch.setattr(owners, "WAITING", 0)
    monkeypatch.setattr(service_job, "PATIENCE", 0.0)
    job_id = worker.submit(duration=0.9375)
    with pytest.raises(TimedOut):
        client.job(job_id).wait(timeout=0.3)
    seen = []

    def report(job):
        seen.append(job.state)
        if job.state == "queued":
            report.claim = worker.start(job_id)
        elif not job.is_finished:
            worker.finish(report.claim, BlockState.done)

    assert client.job(job_id).wait(report=report, timeout=60).state == "succeeded"
    assert seen == ["queued", "running", "succeeded"]


def test_a_lost_service_is_an_error_and_not_an_end(connect, tmp_path, monkeypatch):
    monkeypatch.setattr(service_job, "PATIENCE", 0.5)
    with serving(create_app(Settings(data=tmp_path / "data"))) as url:
        client = connect(url)
        job = client.submit(PENDULUM)
    began = time.monotonic()
    with pytest.raises(Unreachable):
        job.wait()
    assert time.monotonic() - began < 10
    client.close()


def test_a_service_that_comes_back_is_followed_on(connect, tmp_path, monkeypatch):
    settings = Settings(data=tmp_path / "data")
    with serving(create_app(settings)) as url, connect(url) as client:
        job_id = client.submit(PENDULUM).id
    catalogue = Catalogue(settings.catalogue_url)
    with serving(create_app(settings)) as url, connect(url) as client:
        events_of = Connection.events
        broken = []

        def breaking(connection, path, silence):
            """A connection that breaks after the first event, twice."""
            for event in events_of(connection, path, silence):
                yield event
                if len(broken) < 2:
                    broken.append(event)
                    if len(broken) == 2:
                        catalogue.request_cancel(job_id)
                    raise Unreachable("broken")

        monkeypatch.setattr(Connection, "events", breaking)
        assert client.job(job_id).wait(timeout=30, check=False).state == "cancelled"
        assert len(broken) == 2
    catalogue.close()


def test_an_identical_job_is_found_a_key_repeats_and_an_estimate_queues_nothing(client):
    job = PENDULUM | {"duration": uniform(1.2, 1.4)}  # each client's is its own
    assert not client.estimate(job).cached
    first = client.submit(job)
    assert (first.cached, client.submit(job).cached) == (False, True)
    assert client.estimate(job).cached
    anew = job | {"cache": False}
    key = uuid.uuid4().hex
    repeated = [client.submit(anew, idempotency_key=key).id for _ in range(2)]
    assert repeated[0] == repeated[1] != first.id
    with pytest.raises(Refused) as caught:
        client.submit(anew | {"duration": 1.5}, idempotency_key=key)
    assert caught.value.problem == "key-reused"


def test_jobs_are_found_by_what_they_are(client, worker):
    job_id = worker.finished(label="looked for in Python")
    chosen = {"label": "looked for in Python", "state": "succeeded", "kind": "simulate"}
    (found,) = client.jobs(**chosen, scene="seven-bar-press")
    assert found.id == job_id
    hour = timedelta(hours=1)
    now = datetime.now(UTC)
    assert [job.id for job in client.jobs(**chosen, since=now - hour, before=now + hour)] == [
        job_id
    ]
    assert list(client.jobs(**chosen, since=now + hour)) == []
    found.delete()
    assert list(client.jobs(**chosen)) == []
    with pytest.raises(Expired):
        client.job(job_id)


def test_a_job_is_not_deleted_before_it_is_finished(client, worker):
    with pytest.raises(NotFinished, match="cancel it"):
        client.job(worker.submit()).delete()
