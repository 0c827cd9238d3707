"""Files that a job needed while it ran go, also where its last worker could not remove them."""

import shutil
from dataclasses import dataclass

import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob
from jointplay.storage.durable import PARTIAL
from jointplay.storage.settings import Settings
from jointplay.worker.execute import execute
from jointplay.worker.removal import clear_up, tidy

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}


@dataclass
class Left:
    """A job that ended with its second attempt, and what was left of the first one."""

    job: str
    settings: Settings

    def is_left(self) -> list[bool]:
        lost = self.settings.sealed_run(self.job, 1)
        partial = self.settings.object_store.cut_off(self.settings.results_prefix(self.job))
        return [lost.exists(), self.settings.running_folder(self.job).exists(), any(partial)]


@pytest.fixture
def left(catalogue: Catalogue, settings: Settings) -> Left:
    return leave(catalogue, settings)


def leave(catalogue: Catalogue, settings: Settings) -> Left:
    admission = admit(dict(JOB))
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    job = catalogue.submit(new).job.id
    for attempt in (1, 2):
        claim = catalogue.claim_block(f"{job}-0", "here", 60.0)
        assert claim is not None
        folder = settings.running_folder(job) / f"a{attempt}"
        sealed = settings.sealed_run(job, attempt)
        execute(admission, folder, sealed, report=lambda _: "continue")
        if attempt == 1:
            catalogue.release(claim.block.id, attempt)
    catalogue.finish(f"{job}-0", 2, BlockEnd(BlockState.done))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "late").write_bytes(b"late")
    store, key = settings.object_store, sealed.key
    store.replace(f"{key}.0123abcd{PARTIAL}", [b"of a worker that was killed while it sealed"])
    return Left(job, settings)


def test_what_is_left_of_a_job_goes_when_a_lease_is_over(catalogue: Catalogue, left: Left) -> None:
    assert left.is_left() == [True, True, True]
    assert clear_up(catalogue, left.settings) == 0
    assert left.is_left() == [True, True, True]
    assert clear_up(catalogue, left.settings.model_copy(update={"lease": 0.0})) == 1
    assert left.is_left() == [False, False, False]
    assert left.settings.sealed_run(left.job, 2).exists()


def test_who_ends_a_job_removes_what_was_left(catalogue: Catalogue, left: Left) -> None:
    """A whole draft of the results stayed beside them, of whoever was killed before its end."""
    tidy(left.settings, catalogue.blocks(left.job)[0])
    assert left.is_left() == [False, False, False]
    assert left.settings.sealed_run(left.job, 2).exists()


def test_what_is_left_stays_where_the_results_are_damaged(catalogue: Catalogue, left: Left) -> None:
    sealed = left.settings.sealed_run(left.job, 2)
    sealed.object_store.replace(sealed.key, [b"damaged"])
    assert clear_up(catalogue, left.settings.model_copy(update={"lease": 0.0})) == 0
    assert left.is_left() == [True, True, True]


def test_what_cannot_be_removed_keeps_nothing_else(catalogue: Catalogue, left: Left) -> None:
    both = [left.job, leave(catalogue, left.settings).job]
    stuck, other = sorted(both, key=left.settings.running_jobs().index)
    folder = left.settings.running_folder(stuck)
    shutil.rmtree(folder)
    folder.write_text("a file where a folder has to be")
    assert clear_up(catalogue, left.settings.model_copy(update={"lease": 0.0})) == 1
    assert Left(other, left.settings).is_left() == [False, False, False]
