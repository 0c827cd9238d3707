"""A worker that joined and does as it likes, against both kinds of installation."""

import io
import threading
import zipfile
from base64 import b64encode
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import httpx

from jointplay.service.app import create_app
from jointplay.solver.kinds import Study, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.settings import Settings
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, Progress, execute
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.own_solver import own_solver
from jointplay.worker.study_block import run_block
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.service_in_thread import client_of, serving

SWING: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "pendulum"},
    "duration": 2.0,
    "certificate": False,
}
SWEEP: dict[str, Any] = {
    "kind": "sweep",
    "scene": {"preset": "slider-crank"},
    "grid": {"clearance": {"from": 1e-4, "to": 2e-4, "count": 12}},
    "periods": 1,
}
"""Two blocks."""
REFUSED = 422, "/problems/results-refused"
NOT_HELD = 409, "/problems/not-held"


def said(answer: httpx.Response) -> tuple[int, str]:
    return answer.status_code, answer.json()["type"]


class Installation:
    """A service, and what a holder of a key for workers may send it."""

    def __init__(self, url: str, settings: Settings, catalogue: Catalogue) -> None:
        self.url, self.settings, self.catalogue = url, settings, catalogue
        self.http = client_of(url)
        self._number = count(1)

    def submit(self, document: dict[str, Any]) -> Job:
        answer = self.http.post("/v1/jobs", json=document | {"cache": False})
        assert answer.status_code == 202, answer.text
        return self.catalogue.get(answer.json()["id"])

    def claim(self, machine: str = "lab") -> "Held":
        solver = own_solver()
        asked = {
            "program": version("jointplay"),
            "worker": f"{machine}:{next(self._number)}:1:{machine}",
            "wait": 10.0,
        }
        asked |= {"version": solver.version, "processor": solver.processor}
        answer = self.http.post("/v1/worker/claims", json=asked, timeout=60.0)
        assert answer.status_code == 200, answer.text
        block = answer.json()["claim"]["block"]
        return Held(self, block["id"], block["job"], block["attempt"], block["index"])

    def work(self) -> None:
        """Have a worker that joined compute whatever there is, as it should."""
        with closing(Connection(self.url, None)) as connection:
            work(connection, threading.Event(), 1.0)

    def outcomes(self, job: Job) -> list[str | None]:
        return [one.outcome for one in self.catalogue.attempts(job.id)]

    def require_right(self, job: Job, shown: str = "peaks") -> None:
        """Check that a job succeeded with results that can be read."""
        assert self.catalogue.get(job.id).state == "succeeded"
        assert self.http.get(f"/v1/jobs/{job.id}/{shown}").status_code == 200
        assert self.http.get(f"/v1/jobs/{job.id}/zarr.zip").status_code in (200, 307)


class Held:
    """A block that was claimed."""

    def __init__(self, service: Installation, block: str, job: str, number: int, index: int):
        self.service, self.block, self.number, self.index = service, block, number, index
        self.job = service.catalogue.get(job)
        self.path = f"/v1/worker/blocks/{block}/{number}"

    def put(self, name: str, content: bytes, **query: int) -> httpx.Response:
        told = b64encode(sha256(content).digest()).decode()
        headers = {"Content-Digest": f"sha-256=:{told}:"}
        path = f"{self.path}/files/{name}"
        return self.service.http.put(path, content=content, headers=headers, params=query)

    def delete(self, name: str) -> httpx.Response:
        return self.service.http.delete(f"{self.path}/files/{name}")

    def finish(self, **told: Any) -> httpx.Response:
        return self.service.http.post(f"{self.path}/finish", json={"outcome": "done"} | told)

    def put_all(self, folder: Path, names: list[str]) -> None:
        for name in names:
            answer = self.put(name, (folder / name).read_bytes())
            assert answer.status_code == 204, (name, answer.text)


@contextmanager
def installation(kind: str, data: Path, *, redirect: bool = False) -> Iterator[Installation]:
    """Serve from SQLite and a folder, or from PostgreSQL and a bucket, which workers may reach."""
    with ExitStack() as stack:
        servers: dict[str, Any] = {}
        if kind == "bucket":
            server = stack.enter_context(running_server())
            endpoint = stack.enter_context(running_store())
            servers = {
                "catalogue_url": server.new(),
                "results_url": f"s3://{BUCKET}/{data.parent.name}?endpoint={endpoint}",
                "results_redirect": endpoint if redirect else "",
            }
        data.mkdir()
        settings = Settings(data=data, keys="none", **servers)
        catalogue = stack.enter_context(closing(Catalogue(settings.catalogue_url)))
        catalogue.migrate()
        url = stack.enter_context(serving(create_app(settings)))
        found = Installation(url, settings, catalogue)
        stack.enter_context(found.http)
        yield found


@cache
def sealed_run(duration: float, *, half: bool = False) -> bytes:
    """Bytes of the store of a pendulum's run, or of one that was cancelled."""
    return sealed(SWING | {"duration": duration}, half=half)


def sealed(document: dict[str, Any], *, half: bool = False) -> bytes:
    """Bytes of the store of a run, or of one that was cancelled."""

    def report(progress: Progress) -> Answer:
        return Answer.cancel if half else Answer.go_on

    with TemporaryDirectory() as folder:
        target = StoredObject(Folder(folder), "sealed")
        admission = admit(document)
        assert not isinstance(admission, Study)
        execute(admission, Path(folder) / "a1", target, report=report)
        return target.read(0, target.size())


@cache
def study_files(points: int) -> dict[str, bytes]:
    """Files of a sweep of so many clearances: what its blocks leave, and `sealed/study`."""
    study = admit(SWEEP | {"grid": {"clearance": {"from": 1e-4, "to": 2e-4, "count": points}}})
    assert isinstance(study, Study)
    with TemporaryDirectory() as name:
        folder, target = Path(name) / "study", StoredObject(Folder(name), "sealed")
        for index in range(len(study.blocks)):
            assert run_block(study, index, folder).state == "succeeded"
        seal(folder, layout_of_study(study), target)
        found = {
            path.relative_to(name).as_posix(): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file()
        }
        return found | {"sealed/study": target.read(0, target.size())}


def without(content: bytes, lost: str) -> bytes:
    """Bytes of a zip of the same files but one."""
    changed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            if name != lost:
                new.writestr(name, old.read(name))
    return changed.getvalue()
