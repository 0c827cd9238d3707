"""An installation with jobs in every state, as workers leave them, in a folder or a bucket."""

import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import Engine, create_engine, select

from jointplay.records.job import JobError
from jointplay.solver.kinds import Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, Claim, NewJob
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.reconciliation import Finding, findings
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.settings import Settings
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, Progress, execute
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from tests.postgresql_server import Server

RUN = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}
LONG_RUN = RUN | {"duration": 1000.0, "output_step": 0.1}
SWEEP = {"kind": "sweep", "scene": {"preset": "pendulum"}, "duration": 0.1}


class Clock:
    """The true time, and what a test adds to it."""

    def __init__(self) -> None:
        self.ahead = 0.0

    def __call__(self) -> float:
        return time.time() + self.ahead


@dataclass
class Installed:
    """Settings and catalogue of an installation, and its jobs by what became of them."""

    settings: Settings
    catalogue: Catalogue
    clock: Clock
    jobs: dict[str, str] = field(default_factory=dict)

    def submit(self, document: dict[str, Any], label: str) -> str:
        admission = admit({**document, "label": label})
        study = isinstance(admission, Study)
        new = NewJob(
            admission.job["kind"],
            admission.job,
            admission.digest,
            SOLVER_VERSION,
            label=label,
            scene="pendulum",
            blocks=admission.blocks if isinstance(admission, Study) else ((0, 1),),
            seal=study,
        )
        self.jobs[label] = self.catalogue.submit(new).job.id
        return self.jobs[label]

    def claim(self, job: str, index: int = 0) -> Claim:
        claim = self.catalogue.claim_block(f"{job}-{index}", "here:1", self.settings.lease)
        assert claim is not None
        return claim

    def simulate(self, label: str, *, answer: str = "continue") -> Claim:
        claim = self.claim(self.submit(RUN, label))
        admission = admit(claim.job.spec)
        assert not isinstance(admission, Study)
        running = self.settings.running_run(claim.job.id, 1)
        sealed = self.settings.sealed_run(claim.job.id, 1)
        execute(admission, running.folder, sealed, report=lambda _: answer)
        return claim

    def give_up(self, label: str) -> None:
        """Leave a run behind a restart point, and fail it as one that has lost its workers."""
        claim = self.claim(self.submit(LONG_RUN, label))
        admission = admit(claim.job.spec)
        assert not isinstance(admission, Study)

        def report(progress: Progress) -> Answer:
            if not progress.fraction:
                return Answer.go_on
            name, watermark = progress.keep()
            self.catalogue.record_checkpoint(
                claim.block.id, 1, watermark=watermark, checkpoint=name
            )
            return Answer.leave

        folder = self.settings.running_run(claim.job.id, 1).folder
        execute(admission, folder, self.settings.sealed_run(claim.job.id, 1), report=report)
        error = JobError("platform", "worker-lost", "its workers were lost")
        self.catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.failed, error))

    def sweep(self, label: str, *, sealed: bool, angle: float = 0.4) -> str:
        job = self.submit(SWEEP | {"grid": {"angle": [angle, 0.5]}}, label)
        study = admit(self.catalogue.get(job).spec)
        assert isinstance(study, Study)
        folder = self.settings.running_study(job).folder
        claim = self.claim(job)
        run_block(study, 0, folder)
        self.catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.done))
        if sealed:
            claim = self.claim(job, 1)
            seal(folder, layout_of_study(study), self.settings.sealed_study(job))
            self.catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.done))
            self.remove_running(job)
        return job

    def remove_running(self, job: str) -> None:
        shutil.rmtree(self.settings.running_folder(job))

    def sealed(self, label: str) -> StoredObject:
        store = self.settings.object_store
        return StoredObject(store, min(store.list(self.settings.results_prefix(self.jobs[label]))))

    def every_object(self) -> dict[str, StoredObject]:
        """Return all that is stored of jobs, by name."""
        store = self.settings.object_store
        found = {key: StoredObject(store, key) for key in store.list("")}
        for label in self.jobs:
            files = self.running(label)
            found |= {f"{label} {name}": files.object(name) for name in files.names()}
        return found

    def running(self, label: str) -> RunningFiles:
        return self.settings.running_files(self.jobs[label])

    def sql(self, *statements: str, rules: bool = False) -> None:
        """Change the database, past its rules unless they shall hold."""
        url = self.settings.catalogue_url
        if url.startswith("sqlite"):
            setting = f"PRAGMA foreign_keys={'ON' if rules else 'OFF'}"
        else:
            setting = f"SET session_replication_role = {'origin' if rules else 'replica'}"
        engine = engine_at(url)
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            for statement in (setting, *statements):
                connection.exec_driver_sql(statement)
        engine.dispose()

    def look(self) -> list[Finding]:
        return [*findings(self.settings, self.catalogue)]

    def mend(self) -> list[Finding]:
        found = self.look()
        for finding in found:
            if finding.mend is not None:
                finding.mend()
        return found


@pytest.fixture(scope="session")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Make jobs that succeeded, failed, were cancelled, run and wait: their folder and names."""
    folder = tmp_path_factory.mktemp("installation") / "data"
    with opened(folder) as made:
        made.catalogue.migrate()
        made.clock.ahead = -2 * made.settings.lease
        claim = made.simulate("succeeded")
        made.catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.done))
        made.remove_running(claim.job.id)
        claim = made.simulate("cancelled", answer="cancel")
        made.catalogue.request_cancel(claim.job.id)
        made.catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.cancelled))
        made.remove_running(claim.job.id)
        made.sweep("swept", sealed=True)
        made.catalogue.request_cancel(made.sweep("cut short", sealed=False))
        made.catalogue.request_cancel(made.sweep("cut short, too", sealed=False, angle=0.3))
        made.give_up("given up")
        made.clock.ahead = 0.0
        made.simulate("running", answer="leave")
        made.submit(RUN, "waiting")
        return folder, made.jobs


@pytest.fixture
def in_a_folder(whole: tuple[Path, dict[str, str]], tmp_path: Path) -> Iterator[Installed]:
    """Copy the jobs, which were made long enough ago: SQLite and folders."""
    folder, jobs = whole
    shutil.copytree(folder, tmp_path / "data")
    with opened(tmp_path / "data") as copy:
        yield revived(copy, jobs)


@pytest.fixture(scope="session")
def database(postgresql: Server) -> str:
    return postgresql.new()


@pytest.fixture
def in_servers(
    whole: tuple[Path, dict[str, str]],
    database: str,
    new_address: Callable[[], str],
    tmp_path: Path,
) -> Iterator[Installed]:
    """Copy them to PostgreSQL and S3, where what jobs need while they run is as well."""
    folder, jobs = whole
    (tmp_path / "data").mkdir()
    with opened(tmp_path / "data", catalogue_url=database, results_url=new_address()) as copy:
        before = Settings(data=folder)
        copy_rows(before.catalogue_url, database)
        for key in before.object_store.list(""):
            content = before.object_store.read(key, 0, before.object_store.size(key))
            copy.settings.object_store.put(key, [content])
        for job in jobs.values():
            files = before.running_files(job)
            for name in files.names():
                copy.settings.running_files(job).put(name, [files.read(name)])
        yield revived(copy, jobs)


def copy_rows(source: str, target: str) -> None:
    """Copy all rows of a catalogue in SQLite to one in PostgreSQL, in place of those there."""
    files, server = create_engine(source), engine_at(target)
    with files.connect() as read, server.begin() as write:
        for table in reversed(tables.metadata.sorted_tables):
            write.execute(table.delete())
        for table in tables.metadata.sorted_tables:
            if rows := [row._asdict() for row in read.execute(select(table))]:
                write.execute(table.insert(), rows)
    files.dispose()
    server.dispose()


def engine_at(url: str) -> Engine:
    """Reach a database past our own code."""
    return create_engine(url.replace("postgresql://", "postgresql+psycopg://"))


@contextmanager
def opened(data: Path, **addresses: str) -> Iterator[Installed]:
    settings = Settings(data=data, heartbeat=0.05, reserve=0, **addresses)
    clock = Clock()
    catalogue = Catalogue(settings.catalogue_url, clock=clock)
    yield Installed(settings, catalogue, clock)
    catalogue.close()


def revived(copy: Installed, jobs: dict[str, str]) -> Installed:
    copy.jobs |= jobs
    copy.catalogue.heartbeat(f"{jobs['running']}-0", 1, copy.settings.lease)
    return copy
