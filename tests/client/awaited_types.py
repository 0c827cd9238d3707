"""Types that a checker sees of an `AsyncClient`; it is checked and never run."""

from pathlib import Path
from typing import Any, assert_type

from jointplay import AsyncClient
from jointplay.client import AsyncBatch, AsyncJob, Estimate, Job, Window


async def used(client: AsyncClient, document: dict[str, Any]) -> None:
    job = await client.submit(document, idempotency_key="one")
    assert_type(job, AsyncJob)
    assert_type(await client.sweep("slider-crank", {"clearance": [1e-4]}), AsyncJob)
    assert_type(await client.estimate(document), Estimate)
    assert_type(await job.wait(timeout=1.0, report=told), AsyncJob)
    assert_type(await job.window("A.*", 0.0, step=1e-4), Window)
    assert_type(await job.statistics, dict[str, Any])
    assert_type(await job.figures, list[str])
    assert_type(await (await job.figure("orbit")).save("orbit.pdf"), Path)
    assert_type(job.state, str)
    async for seen in job.follow(timeout=1.0):
        assert_type(seen, AsyncJob)
    async for found in client.jobs(state="running"):
        assert_type(found, AsyncJob)
    async for ended in await client.map([document]):
        assert_type(ended, AsyncJob)
    async for batch in client.batches():
        assert_type(await batch.cancel(), AsyncBatch)
        assert_type(await batch.retry(), AsyncBatch)
    assert_type(await job.retry(), AsyncJob)
    await client.job(5)  # type: ignore[arg-type]
    await job.wait(timeot=1.0)  # type: ignore[call-arg]


def told(job: Job) -> None:
    """Take a job that has changed."""
