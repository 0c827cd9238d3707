"""A catalogue in PostgreSQL that is lost and found again, while a whole service computes."""

import itertools
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from jointplay.client import Client
from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from tests.faults.jobs import IMPATIENT
from tests.postgresql_server import Server, running_server


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with running_server() as server:
        yield server


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
            if all(job.refresh().state == "succeeded" for job in jobs) and turn > 12:
                break
            if turn % 5 == 4:
                server.stop()
                time.sleep(1.0)  # away for longer than it takes to connect anew
                server.start()
            else:
                server.cut(url)
            if turn < 12:
                scene = {"preset": "slider-crank", "parameters": {"clearance": 1e-4 + 1e-7 * turn}}
                jobs.append(client.submit({"kind": "simulate", "scene": scene, "duration": 2.0}))
            assert all(job.refresh().state not in ("failed", "cancelled") for job in jobs)
            time.sleep(0.3)
        assert all(block.losses == 0 for job in jobs for block in catalogue.blocks(job.id))
        catalogue.close()
