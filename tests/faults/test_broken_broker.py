"""Redis only wakes workers: killing or wiping it delays jobs and loses none."""

import os
import signal
from pathlib import Path

from jobs import Service, ended, in_mid_block, submit
from redis import Redis

from jointplay.service.processes.broker import answers
from jointplay.solver.kinds import admit
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.settings import Settings
from tests.waiting import until

LONG = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 150.0}
SHORT = LONG | {"duration": 1.0}


def broker_url(settings: Settings) -> str:
    return f"unix://{settings.data / 'broker' / 'redis.sock'}"


def broker_pid(settings: Settings) -> int:
    with Redis.from_url(broker_url(settings)) as redis:
        return int(redis.info("server")["process_id"])


def test_jobs_outlive_a_wiped_and_a_killed_broker(service: Service) -> None:
    settings, catalogue = service
    long, short = admit(LONG), admit(SHORT)
    running = [submit(catalogue, long) for _ in range(2)]  # one for each worker
    for job in running:
        in_mid_block(catalogue, job)
    waiting = [submit(catalogue, short) for _ in range(3)]
    with Redis.from_url(broker_url(settings)) as redis:
        until(lambda: redis.llen("jointplay:interactive") >= 3)
        redis.flushall()
    os.kill(broker_pid(settings), signal.SIGKILL)
    waiting.append(submit(catalogue, short))
    until(lambda: answers(broker_url(settings)))
    waiting.append(submit(catalogue, short))
    jobs = [ended(catalogue, job) for job in [*running, *waiting]]
    assert {job.state for job in jobs} == {JobState.succeeded}
    assert [job.attempt for job in jobs] == [1] * len(jobs)
    log = Path(settings.data / "logs" / "serve.log").read_text()
    assert "broker ended, starting it again" in log
