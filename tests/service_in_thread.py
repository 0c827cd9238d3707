"""Fixtures: the real service in a thread, and a worker that is played by hand."""

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
import uvicorn
from fastapi import FastAPI

from service.app import create_app
from solver.admission import Admission, admit
from storage.catalogue import BlockState, Catalogue, Claim, JobError
from storage.results import IMPACT, ArraySpec, Peak, ResultLayout, ResultWriter
from storage.settings import Settings

LEDGER = (
    "driver_work",
    "gravity_work",
    "contact_loss",
    "friction_loss",
    "kinetic_change",
    "stored_change",
    "residual",
)


@contextmanager
def serving(app: FastAPI) -> Iterator[str]:
    """Serve ``app`` with uvicorn in a thread; the socket listens before, so nobody has to wait."""
    # the protocol is named, else asyncio leaves Nagle's algorithm on: 40 ms a request
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.bind(("127.0.0.1", 0))
    listener.listen()
    server = uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="on"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}"
    finally:
        server.should_exit = True
        thread.join()
        listener.close()


@pytest.fixture(scope="session")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    return Settings(data=tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="session")
def service_url(settings: Settings) -> Iterator[str]:
    """Address of the real application: SQLite and results in a temporary folder, no worker."""
    with serving(create_app(settings)) as url:
        yield url


@pytest.fixture(scope="session")
def http(service_url: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=service_url, trust_env=False) as client:
        yield client


@pytest.fixture
def fresh_service(tmp_path: Path) -> Iterator[str]:
    """A service of its own, without jobs."""
    with serving(create_app(Settings(data=tmp_path / "data"))) as url:
        yield url


@pytest.fixture(scope="session")
def catalogue(settings: Settings, service_url: str) -> Iterator[Catalogue]:
    """The catalogue of the running service, as a worker sees it."""
    catalogue = Catalogue(settings.catalogue_url)
    yield catalogue
    catalogue.close()


class Worker:
    """Does what a worker does, by hand: known numbers instead of a simulation."""

    def __init__(self, http: httpx.Client, catalogue: Catalogue, settings: Settings) -> None:
        self._http = http
        self._catalogue = catalogue
        self._settings = settings

    def submit(self, **fields: Any) -> str:
        job = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
        answer = self._http.post("/v1/jobs", json=job | fields)
        assert answer.status_code == 202, answer.text
        return str(answer.json()["id"])

    def start(self, job_id: str) -> Claim:
        (block,) = self._catalogue.blocks(job_id)
        claim = self._catalogue.claim_block(block.id, "test", 60.0)
        assert claim is not None
        return claim

    def store(self, claim: Claim, *, complete: bool = True) -> None:
        """Store value = column + time, peaks -1 and 1, and one impact without a release."""
        admission, writer = self._writer(claim)
        channels = admission.channels
        time = np.linspace(0.0, admission.job["duration"], admission.samples)
        section_time = np.arange(float(admission.sections))
        columns = np.arange(float(len(channels)))
        impacts = np.array([(1, 0.5, np.nan, 0.01, 100.0, 0.2)], IMPACT)
        writer.append(
            0,
            time,
            columns + time[:, None],
            0,
            section_time,
            columns + section_time[:, None],
            impacts,
        )
        peaks = {channel.name: Peak(-1.0, 0.25, 1.0, 0.75) for channel in channels}
        energy = dict.fromkeys(LEDGER, 0.0) | {"driver_work": 2.5, "residual": 1e-6}
        summary = {"steps": 7, "rejections": 1, "onsets": 2, "smallest_step": 1e-6}
        summary |= {"solver_seconds": 0.25, "energy": energy}
        writer.seal(peaks=peaks, summary=summary, complete=complete)

    def store_nothing(self, claim: Claim) -> None:
        """Seal the results of a run that ended before its first sample."""
        _, writer = self._writer(claim)
        writer.seal(peaks={}, summary={}, complete=False)

    def _writer(self, claim: Claim) -> tuple[Admission, ResultWriter]:
        admission = admit(claim.job.spec)
        folder = self._settings.result_folder(claim.job.id, claim.block.attempt)
        channels = tuple(ArraySpec(c.name, c.unit, c.long_name) for c in admission.channels)
        attributes = {"job": admission.job, "scene": admission.scene, "section_note": ""}
        layout = ResultLayout(
            channels, admission.samples, admission.sections, admission.joints, attributes
        )
        return admission, ResultWriter.create(folder, layout)

    def finish(self, claim: Claim, outcome: BlockState, error: JobError | None = None) -> None:
        self._catalogue.finish(claim.block.id, claim.block.attempt, outcome, error)

    def finished(self, **fields: Any) -> str:
        """A job that succeeded, with its results."""
        claim = self.start(self.submit(**fields))
        self.store(claim)
        self.finish(claim, BlockState.done)
        return claim.job.id


@pytest.fixture(scope="session")
def worker(http: httpx.Client, catalogue: Catalogue, settings: Settings) -> Worker:
    return Worker(http, catalogue, settings)


@pytest.fixture(scope="session")
def finished_job(worker: Worker) -> str:
    return worker.finished(label="finished")
