"""A catalogue in PostgreSQL that is lost and found again, while a whole service computes."""

import itertools
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from jointplay.client import Client, Job
from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from tests.faults.jobs import IMPATIENT
from tests.postgresql_server import Server, running_server
from tests.waiting import until


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with running_server() as server:
        yield server


def is_ready(address: str) -> bool:
    return httpx.get(f"{address}/readyz", trust_env=False, timeout=300.0).is_success


def standing(jobs: list[Job]) -> list[object]:
    return [job.refresh().progress for job in jobs]


def all_succeeded(jobs: list[Job]) -> bool:
    return all(job.refresh().state == "succeeded" for job in jobs)


@pytest.mark.long
def test_neither_cut_connections_nor_restarts_end_a_job(server: Server, tmp_path: Path) -> None:
    url = server.new("template0")
    environment = IMPATIENT | {"JOINTPLAY_CATALOGUE_URL": url}
    with running_service(tmp_path, 2, environment) as address, Client(address) as client:
        catalogue = Catalogue(url)
        jobs = [
            client.submit({"kind": "simulate", "scene": {"preset": name}, "duration": 20.0})
            for name in ("slider-crank", "seven-bar-press")
        ]
        for turn in itertools.count():
            if all_succeeded(jobs) and turn > 12:
                break
            if turn % 5 == 4:
                server.stop()
                until(lambda: not is_ready(address))
                server.start()
            else:
                server.cut(url)
            if turn < 12:
                scene = {"preset": "slider-crank", "parameters": {"clearance": 1e-4 + 1e-7 * turn}}
                jobs.append(client.submit({"kind": "simulate", "scene": scene, "duration": 2.0}))
            assert all(job.refresh().state not in ("failed", "cancelled") for job in jobs)
            before = standing(jobs)
            until(lambda: standing(jobs) != before or all_succeeded(jobs))  # noqa: B023
        assert all(block.losses == 0 for job in jobs for block in catalogue.blocks(job.id))
        catalogue.close()
