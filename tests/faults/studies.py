"""Studies put straight into the catalogue, their bytes, and processes that are stopped."""

import os
import signal
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from jointplay.solver.kinds import Study
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job, JobState, NewJob
from jointplay.storage.packed.reading import Packed
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import seal
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from tests.stores import files_of, packed, target
from tests.waiting import until


def undisturbed_files(study: Study, folder: Path) -> dict[str, bytes]:
    """Compute a study here; return the files of its store."""
    for index in range(len(study.blocks)):
        assert run_block(study, index, folder).state == "succeeded"
    seal(folder, layout_of_study(study), target(folder))
    return files_of(packed(folder))


def submit(catalogue: Catalogue, study: Study) -> str:
    new = NewJob(
        study.kind, study.job, study.digest, SOLVER_VERSION, blocks=study.blocks, seal=True
    )
    return catalogue.submit(new).job.id


def assert_same_bytes(settings: Settings, job: Job, undisturbed: dict[str, bytes]) -> None:
    assert job.state is JobState.succeeded
    sealed = settings.sealed_study(job.id)
    stored = files_of(sealed)
    assert stored.keys() == undisturbed.keys()
    assert [key for key, content in undisturbed.items() if stored[key] != content] == []
    reader = StudyReader(Packed(sealed))
    assert reader.complete
    reader.verify()


@contextmanager
def stalled(settings: Settings, process: int) -> Iterator[None]:
    """Stop a process, but not while it holds the catalogue, and let it go on at the end."""

    def is_stopped_outside_of_transactions() -> bool:
        os.kill(process, signal.SIGSTOP)
        database = sqlite3.connect(settings.data / "catalogue.sqlite", timeout=0.5)
        try:
            database.execute("BEGIN IMMEDIATE")
            database.rollback()
        except sqlite3.OperationalError:
            os.kill(process, signal.SIGCONT)
            return False
        finally:
            database.close()
        return True

    until(is_stopped_outside_of_transactions)
    try:
        yield
    finally:
        os.kill(process, signal.SIGCONT)
