"""The client in an event loop: many jobs at a time, cancellation, and what editors see."""

import asyncio
import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.client import AsyncBatch, AsyncClient, AsyncJob, Batch, Client, ClientError, Job
from jointplay.storage.catalogue.records import BlockState

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}
ROOT = Path(__file__).resolve().parents[2]
TYPES = Path(__file__).with_name("awaited_types.py")


@pytest.mark.parametrize(
    ("awaited", "blocking", "without"),
    [(AsyncClient, Client, set()), (AsyncJob, Job, {"results"}), (AsyncBatch, Batch, set())],
)
def test_every_verb_is_there(awaited, blocking, without):
    names = {name for name in dir(blocking) if not name.startswith("_")}
    assert names - set(dir(awaited)) == without


def test_twenty_jobs_are_followed_at_once(service_url, worker):
    """No job ends before all are followed."""

    async def followed(client, everybody):
        job = await client.submit(PENDULUM)
        states = []
        async for seen in job.follow():
            states.append(seen.state)
            if len(states) == 1:
                await everybody.wait()
                await asyncio.to_thread(end, job.id)
        assert job.is_finished
        assert seen == job
        return states

    def end(job_id):
        worker.finish(worker.start(job_id), BlockState.done)

    async def together():
        everybody = asyncio.Barrier(20)
        async with AsyncClient(service_url) as client:
            return await asyncio.gather(*(followed(client, everybody) for _ in range(20)))

    for first, *_, last in asyncio.run(together()):
        assert (first, last) == ("queued", "succeeded")


def test_a_task_that_waits_for_a_job_can_be_cancelled(service_url):
    async def given_up():
        async with AsyncClient(service_url) as client:
            job = await client.submit(PENDULUM)
            followed = asyncio.Event()
            waiting = asyncio.create_task(job.wait(report=lambda seen: followed.set()))
            await followed.wait()
            waiting.cancel()
            with pytest.raises(asyncio.CancelledError):
                await waiting
            with pytest.raises(TimeoutError):
                async with asyncio.timeout(0.1):
                    await job.wait()
            async for _ in job.follow():
                break
            return (await job.cancel()).state

    assert asyncio.run(given_up()) == "cancelled"


def test_a_report_may_ask_and_nobody_else_without_awaiting(service_url):
    async def reported():
        async with AsyncClient(service_url) as client:
            job = await client.submit(PENDULUM)
            seen = []

            def report(blocking):
                seen.append(blocking.cancel())

            await job.wait(report=report, check=False)
            with pytest.raises(ClientError, match="where it is awaited"):
                seen[0].refresh()
            return job.state

    assert asyncio.run(reported()) == "cancelled"


@pytest.mark.long
def test_editors_see_what_is_awaited():
    command = [sys.executable, "-m", "mypy", str(TYPES)]
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout
