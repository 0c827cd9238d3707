"""Waiting for a job: long polls, preferences, the stream of its events."""

import asyncio
import json
import threading
import time
from functools import partial

import httpx
import pytest

from jointplay.records.job import JobError
from jointplay.service import events
from jointplay.service.access import Caller, authentication
from jointplay.service.jobs.waiting import Watcher
from jointplay.service.vital import VitalThreads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Broken
from jointplay.storage.catalogue.keys import id_in
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE, until

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}
SOON = 1.0  # s in which an answer comes on a busy machine that looks every 25 to 100 ms


def later(seconds, do, *arguments):
    timer = threading.Timer(seconds, do, arguments)
    timer.start()
    return timer


def parsed(text):
    """Return (id, type, data) of each event."""
    events = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if line[:1] != ":")
        if "data" in fields:
            events.append((fields.get("id"), fields["event"], json.loads(fields["data"])))
    return events


@pytest.mark.parametrize("how", ["query", "header"])
def test_waiting_ends_when_the_job_does(http, worker, how):
    claim = worker.start(worker.submit())
    ended = later(0.4, worker.finish, claim, BlockState.done)
    began = time.monotonic()
    asked = (
        {"params": {"wait": 20}} if how == "query" else {"headers": {"Prefer": "wait=20, foo=bar"}}
    )
    answer = http.get(f"/v1/jobs/{claim.job.id}", **asked, timeout=30)
    took = time.monotonic() - began
    ended.join()
    assert answer.json()["state"] == "succeeded"
    assert 0.4 <= took < 0.4 + SOON
    assert answer.headers.get("Preference-Applied") == ("wait=20" if how == "header" else None)


def test_waiting_ends_after_its_time(http, worker):
    job_id = worker.submit()
    began = time.monotonic()
    assert http.get(f"/v1/jobs/{job_id}", params={"wait": 0.3}).json()["state"] == "queued"
    assert 0.3 <= time.monotonic() - began < 0.3 + SOON
    assert http.get(f"/v1/jobs/{job_id}", params={"wait": 0}).json()["state"] == "queued"


def test_waiting_ends_where_a_change_comes_as_its_time_ends(catalogue, worker):
    job_id = worker.submit()

    async def waited():
        watcher = Watcher(catalogue)

        def show_late():
            time.sleep(0.2)  # the time is over by now, which the loop has not seen
            for watch in watcher._watches[job_id]:
                watch.show(watch.latest)

        waiting = asyncio.create_task(watcher.finished(job_id, 0.3))
        asyncio.get_running_loop().call_later(0.25, show_late)
        done, _ = await asyncio.wait([waiting], timeout=PATIENCE)
        waiting.cancel()
        return done == {waiting} and not waiting.result()

    assert asyncio.run(waited())


class Counting(Catalogue):
    """A catalogue that counts looks in vain."""

    in_vain = 0

    def statuses(self, jobs):
        try:
            return super().statuses(jobs)
        except Broken:
            self.in_vain += 1
            raise


def test_who_waits_goes_on_where_the_database_failed_for_a_while(tmp_path):
    """As while it is restored."""
    catalogue = Counting(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    catalogue.migrate()
    job = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).job.id

    def renamed(old, new):
        with catalogue.connections.writing() as connection:
            connection.exec_driver_sql(f"ALTER TABLE {old} RENAME TO {new}")

    async def seen():
        with Watcher(catalogue).watching(job) as watch:
            assert (await watch.change(PATIENCE)).state is JobState.queued
            renamed("job", "away")
            await asyncio.to_thread(until, lambda: catalogue.in_vain)
            renamed("away", "job")
            catalogue.request_cancel(job)
            return await watch.change(PATIENCE)

    assert asyncio.run(seen()).state is JobState.cancelled
    catalogue.close()


def test_a_stream_goes_on_once_the_catalogue_is_back(tmp_path, monkeypatch):
    """Its key was looked up while the file was away, and the stream broke off."""
    monkeypatch.setattr(authentication, "_REMEMBERED", 0.0)
    monkeypatch.setattr(events, "_QUIET", 0.05)
    settings = Settings(data=tmp_path, keys="required")
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    key = id_in(catalogue.make_key("ada", ("jobs:read",), "", None)[0])
    job = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1", owner="ada")).job
    file, away = tmp_path / "catalogue.sqlite", tmp_path / "away"

    async def streamed():
        opens = authentication.Authentication(catalogue, settings, VitalThreads()).still_open_to
        still = partial(opens, Caller("ada", frozenset({"jobs:read"}), key))
        stream = events._stream(job, catalogue, Watcher(catalogue), 0, still)
        heard = b""
        async for piece in stream:
            heard += piece
            if b"event: queued" in piece:
                file.rename(away)
            if piece == b": the job goes on\n\n" and away.exists():
                away.rename(file)
                catalogue.request_cancel(job.id)
        return heard

    assert b"event: cancelled" in asyncio.run(asyncio.wait_for(streamed(), PATIENCE))
    catalogue.close()


def test_events_are_read_once_the_catalogue_answers(tmp_path, caplog):
    catalogue = Catalogue(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    catalogue.migrate()
    job = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).job.id
    file, away = tmp_path / "catalogue.sqlite", tmp_path / "away"

    async def read():
        file.rename(away)
        further = asyncio.create_task(events._further(catalogue, job, 0))
        await asyncio.to_thread(until, lambda: "looking again" in caplog.text)
        away.rename(file)
        return await further

    assert [one.type for one in asyncio.run(read())] == ["queued"]
    catalogue.close()


def test_a_submission_may_be_waited_for(http, worker, catalogue):
    answer = http.post("/v1/jobs", json=PENDULUM, headers={"Prefer": "wait=1"})
    assert (answer.status_code, answer.json()["state"]) == (202, "queued")
    assert answer.headers["Preference-Applied"] == "wait=1"

    def compute_it():
        job = catalogue.jobs(limit=1, label="waited for").jobs[0]
        worker.finish(worker.start(job.id), BlockState.done)

    ended = later(0.4, compute_it)
    job = PENDULUM | {"label": "waited for"}
    answer = http.post("/v1/jobs", json=job, headers={"Prefer": "wait=20"}, timeout=30)
    ended.join()
    assert (answer.status_code, answer.json()["state"]) == (200, "succeeded")
    assert answer.json()["cached"] is False


def test_many_may_wait_at_once(http, service_url, worker, application):
    """More than there are threads: waiting holds none."""
    claim = worker.start(worker.submit())
    states = []

    def wait():
        answer = httpx.get(
            f"{service_url}/v1/jobs/{claim.job.id}?wait=30", timeout=60, trust_env=False
        )
        states.append(answer.json()["state"])

    threads = [threading.Thread(target=wait) for _ in range(60)]
    for thread in threads:
        thread.start()
    until(lambda: len(application.state.watcher._watches.get(claim.job.id, ())) == len(threads))
    assert http.get("/healthz").is_success
    worker.finish(claim, BlockState.done)
    for thread in threads:
        thread.join()
    assert states == ["succeeded"] * 60


@pytest.mark.parametrize("wait", ["-1", "61", "nan", "inf", "long", ""])
def test_a_wrong_wait_is_refused(http, worker, wait):
    answer = http.get(f"/v1/jobs/{worker.submit()}", params={"wait": wait})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["parameter"] == "wait"


def test_a_preference_that_is_none_is_ignored(http, worker):
    for prefer in ("wait", "wait=", "wait=soon", "respond-async", "await=5", "wait=0"):
        answer = http.get(f"/v1/jobs/{worker.submit()}", headers={"Prefer": prefer})
        assert answer.status_code == 200


def test_the_stream_tells_what_happens_and_ends_with_the_job(http, catalogue, worker):
    job_id = worker.submit()
    seen = []
    with http.stream("GET", f"/v1/jobs/{job_id}/events", timeout=30) as stream:
        assert stream.headers["Content-Type"].startswith("text/event-stream")
        assert stream.headers["Cache-Control"] == "no-store"
        claim = None
        for line in stream.iter_lines():
            if not line.startswith("data: "):
                continue
            data = json.loads(line.removeprefix("data: "))
            seen.append(data)
            if "progress" not in data:
                continue
            if data["state"] == "queued":
                claim = worker.start(job_id)
            elif data["state"] == "running" and data["progress"]["fraction"] == 0:
                catalogue.record_progress(
                    claim.block.id, 1, 60.0, time=1.0, fraction=0.5, steps=1234
                )
            elif data["state"] == "running":
                error = JobError("solver", "step-size-underflow", "No step.", 1.5)
                worker.finish(claim, BlockState.failed, error)
    history = [event for event in seen if "seq" in event]
    assert [event["seq"] for event in history] == [1, 2, 3, 4]
    assert [event["type"] for event in history] == ["queued", "running", "claimed", "failed"]
    assert history[-1]["data"]["error"]["code"] == "step-size-underflow"
    progress = [event["progress"] for event in seen if "progress" in event]
    assert {"time": 1.0, "fraction": 0.5, "steps": 1234} in progress
    assert seen[-1]["state"] == "failed"


def test_a_stream_goes_on_after_the_last_event_that_was_received(http, worker):
    job_id = worker.finished()
    address = f"/v1/jobs/{job_id}/events"
    whole = [event for event in parsed(http.get(address).text) if event[0]]
    assert [event[0] for event in whole] == ["1", "2", "3", "4"]
    for last in (1, 3):
        rest = parsed(http.get(address, headers={"Last-Event-ID": str(last)}).text)
        assert [event for event in rest if event[0]] == whole[last:]
        assert rest[-1][1] == "progress"
    assert http.get(address, headers={"Last-Event-ID": "4"}).status_code == 204
    for wrong in ("x", "-1", str(2**31), "1.5"):
        answer = http.get(address, headers={"Last-Event-ID": wrong})
        assert answer.status_code == 422
        assert answer.json()["errors"][0]["parameter"] == "Last-Event-ID"


def test_a_stream_begins_anew_for_who_knows_more_events_than_there_are(http, worker):
    """An older catalogue was restored: what happened since then was waited for, and never sent."""
    job_id = worker.finished()
    address, later_one = f"/v1/jobs/{job_id}/events", {"Last-Event-ID": "5"}
    sent = [event[0] for event in parsed(http.get(address, headers=later_one).text) if event[0]]
    assert sent == ["1", "2", "3", "4"]
    waiting = worker.submit()
    address = f"/v1/jobs/{waiting}/events"
    lines = []
    with http.stream("GET", address, headers=later_one, timeout=30) as stream:
        for line in stream.iter_lines():
            lines.append(line)
            if line == "event: progress" and lines.count(line) == 1:
                http.post(f"/v1/jobs/{waiting}/cancel")
    history = [(event[0], event[1]) for event in parsed("\n".join(lines)) if event[0]]
    assert history == [("1", "queued"), ("2", "cancelled")]


def test_there_are_no_events_of_a_job_that_is_none(http):
    assert http.get("/v1/jobs/nope/events").status_code == 404
