"""An installation with jobs in every state, as workers leave them."""

import shutil
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from jointplay.solver.kinds import Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, Claim, NewJob
from jointplay.storage.reconciliation import Finding, findings
from jointplay.storage.settings import Settings
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import execute
from jointplay.worker.study_block import layout_of, run_block

RUN = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}
SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "pendulum"},
    "grid": {"angle": [0.4, 0.5]},
    "duration": 0.1,
}


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

    def sweep(self, label: str, *, sealed: bool) -> str:
        job = self.submit(SWEEP, label)
        study = admit(self.catalogue.get(job).spec)
        assert isinstance(study, Study)
        folder = self.settings.running_study(job).folder
        claim = self.claim(job)
        run_block(study, 0, folder)
        self.catalogue.finish(claim.block.id, 1, BlockState.done)
        if sealed:
            claim = self.claim(job, 1)
            seal(folder, layout_of(study), self.settings.sealed_study(job))
            self.catalogue.finish(claim.block.id, 1, BlockState.done)
            self.remove_running(job)
        return job

    def remove_running(self, job: str) -> None:
        shutil.rmtree(self.settings.running_folder(job))

    def sealed(self, label: str) -> Path:
        return min((self.settings.data / "results").glob(f"*/{self.jobs[label]}-*"))

    def running(self, label: str) -> Path:
        return self.settings.running_folder(self.jobs[label])

    def sql(self, *statements: str) -> None:
        """Change the database past its rules."""
        with closing(sqlite3.connect(self.settings.data / "catalogue.sqlite")) as database:
            for statement in statements:
                database.execute(statement)
            database.commit()

    def look(self) -> list[Finding]:
        return [*findings(self.settings, self.catalogue)]

    def mend(self) -> list[Finding]:
        found = self.look()
        for finding in found:
            if finding.mend is not None:
                finding.mend()
        return found


@pytest.fixture(scope="package")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Make jobs that succeeded, failed, were cancelled, run and wait: their folder and names."""
    folder = tmp_path_factory.mktemp("installation") / "data"
    with opened(folder) as made:
        made.catalogue.migrate()
        made.clock.ahead = -2 * made.settings.lease
        claim = made.simulate("succeeded")
        made.catalogue.finish(claim.block.id, 1, BlockState.done)
        made.remove_running(claim.job.id)
        claim = made.simulate("cancelled", answer="cancel")
        made.catalogue.request_cancel(claim.job.id)
        made.catalogue.finish(claim.block.id, 1, BlockState.cancelled)
        made.remove_running(claim.job.id)
        made.sweep("swept", sealed=True)
        made.catalogue.request_cancel(made.sweep("cut short", sealed=False))
        made.clock.ahead = 0.0
        made.simulate("running", answer="leave")
        made.submit(RUN, "waiting")
        return folder, made.jobs


@pytest.fixture
def installed(whole: tuple[Path, dict[str, str]], tmp_path: Path) -> Iterator[Installed]:
    """Copy the jobs, which were made long enough ago."""
    folder, jobs = whole
    shutil.copytree(folder, tmp_path / "data")
    with opened(tmp_path / "data") as copy:
        copy.jobs |= jobs
        copy.catalogue.heartbeat(f"{jobs['running']}-0", 1, copy.settings.lease)
        yield copy


@contextmanager
def opened(data: Path) -> Iterator[Installed]:
    settings = Settings(data=data, heartbeat=0.05, reserve=0)
    clock = Clock()
    catalogue = Catalogue(settings.catalogue_url, clock=clock)
    yield Installed(settings, catalogue, clock)
    catalogue.close()
