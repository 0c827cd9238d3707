"""Faults of the platform that may pass delay a job and never end it."""

import shutil
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, closing, contextmanager
from pathlib import Path

import pytest
from one_block import run

from jointplay.solver.kinds import Admission
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue import connections
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob
from jointplay.storage.installation import require_own_files
from jointplay.storage.settings import Settings
from jointplay.worker import block_run
from jointplay.worker.block_run import BlockRun
from jointplay.worker.scratch.computing import compute
from tests.stores import files_of, sealed_run
from tests.waiting import until


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "_PATIENCE", 0.1)
    monkeypatch.setattr(block_run, "ASK_AGAIN", 0.1)


def submit(catalogue: Catalogue, admission: Admission) -> str:
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    return catalogue.submit(new).job.id


def stored(catalogue: Catalogue, settings: Settings, job: str) -> dict[str, bytes]:
    ended = catalogue.get(job)
    assert ended.state is JobState.succeeded
    sealed_run(settings, ended).verify()
    files = files_of(settings.sealed_run(job, ended.attempt))
    # the documents tell the seconds that it took, too
    return {key: content for key, content in files.items() if not key.endswith(".json")}


@contextmanager
def held_by_another_program(settings: Settings, _: Catalogue) -> Iterator[None]:
    other = sqlite3.connect(settings.data / "catalogue.sqlite", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    try:
        yield
    finally:
        other.execute("ROLLBACK")
        other.close()


@contextmanager
def out_of_reach(settings: Settings, catalogue: Catalogue) -> Iterator[None]:
    """Lose the connections to the database, which cannot be made anew while the block runs."""
    file, elsewhere = settings.data / "catalogue.sqlite", settings.data / "elsewhere.sqlite"
    catalogue.close()
    file.rename(elsewhere)
    file.symlink_to(settings.data)  # a folder
    yield
    elsewhere.replace(file)  # at once: in between, a new database would be made


@contextmanager
def being_restored(settings: Settings, _: Catalogue) -> Iterator[None]:
    """Take a table away from a database to which there are connections."""
    with closing(sqlite3.connect(settings.data / "catalogue.sqlite")) as other:
        other.execute("ALTER TABLE block RENAME TO away")
        yield
        other.execute("ALTER TABLE away RENAME TO block")


def test_results_that_cannot_be_written_are_tried_again(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    undisturbed = submit(catalogue, admission)
    run(catalogue, settings, f"{undisturbed}-0")
    shutil.move(settings.data / "results", settings.data / "elsewhere")
    (settings.data / "results").write_text("a file where a folder has to be")
    job = submit(catalogue, admission)
    run(catalogue, settings, f"{job}-0")
    waiting = catalogue.get(job)
    assert (waiting.state, waiting.activity) == (JobState.running, "waiting for the object store")
    assert [block.losses for block in catalogue.blocks(job)] == [0]
    assert catalogue.blocks(job)[0].state is BlockState.queued
    (settings.data / "results").unlink()
    shutil.move(settings.data / "elsewhere", settings.data / "results")
    run(catalogue, settings, f"{job}-0")
    assert [one.outcome for one in catalogue.attempts(job)] == ["put-off", "done"]
    same = stored(catalogue, settings, job), stored(catalogue, settings, undisturbed)
    assert same[0] == same[1]
    assert catalogue.get(job).activity is None
    assert not settings.running_folder(job).exists()
    assert not list(settings.data.rglob("*.partial"))


@pytest.fixture
def mounted(settings: Settings, catalogue: Catalogue) -> Settings:
    """Results on a disk of their own."""
    disk = settings.data / "disk"
    apart = settings.model_copy(update={"results_url": f"file:{disk}", "data": settings.data / "d"})
    apart.data.mkdir()
    require_own_files(apart, catalogue)
    return apart


def unmount(settings: Settings) -> Path:
    """Return what is seen in place of the disk: an empty folder."""
    disk = Path(settings.results_url.removeprefix("file:"))
    disk.rename(disk.with_name("unmounted"))
    disk.mkdir()
    return disk


def mount(disk: Path) -> None:
    shutil.rmtree(disk)
    disk.with_name("unmounted").rename(disk)


def test_nothing_is_computed_while_the_disk_for_results_is_not_mounted(
    catalogue: Catalogue, mounted: Settings, admission: Admission
) -> None:
    disk = unmount(mounted)
    job = submit(catalogue, admission)

    def tried() -> None:
        claim = catalogue.claim_block(f"{job}-0", "this process", mounted.lease)
        assert claim is not None
        compute(catalogue, mounted, claim, threading.Event())

    tried()
    assert catalogue.get(job).activity == "waiting for the object store"
    assert not mounted.running_folder(job).exists()
    mount(disk)
    tried()
    stored(catalogue, mounted, job)


def test_results_stored_in_place_of_a_disk_that_went_are_stored_again_when_it_is_back(
    catalogue: Catalogue, mounted: Settings, admission: Admission
) -> None:
    """They would be hidden beneath it, and the job would have succeeded without results."""
    job = submit(catalogue, admission)
    claim = catalogue.claim_block(f"{job}-0", "this process", mounted.lease)
    assert claim is not None
    computing = threading.Thread(
        target=compute, args=(catalogue, mounted, claim, threading.Event()), daemon=True
    )
    computing.start()
    until(mounted.running_folder(job).exists)
    disk = unmount(mounted)
    computing.join()
    assert [one.outcome for one in catalogue.attempts(job)] == ["put-off"]
    assert [*disk.rglob("*.zip")]
    mount(disk)
    claim = catalogue.claim_block(f"{job}-0", "this process", mounted.lease)
    assert claim is not None
    compute(catalogue, mounted, claim, threading.Event())
    stored(catalogue, mounted, job)


def test_a_full_disk_is_waited_for_with_ever_longer_pauses(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    job = submit(catalogue, admission)
    more_than_there_is = settings.model_copy(update={"reserve": 2**60})
    pauses = []
    for _ in range(6):
        run(catalogue, more_than_there_is, f"{job}-0")
        assert catalogue.due_wake_ups(10) == ()
        now = time.time()
        catalogue.clock = lambda now=now: now + 6.0  # type: ignore[misc]
        assert len(catalogue.due_wake_ups(10)) == 1
        catalogue.clock = time.time
        with catalogue.connections.reading() as connection:
            due = connection.exec_driver_sql("SELECT due FROM outbox").scalar_one()
        pauses.append(round(due - now))
    assert pauses == [2, 4, 5, 5, 5, 5]
    assert catalogue.get(job).activity == "waiting for room on the disk"
    run(catalogue, settings, f"{job}-0")
    stored(catalogue, settings, job)


def test_sealing_leaves_half_of_the_reserve_to_the_catalogue(
    catalogue: Catalogue,
    settings: Settings,
    admission: Admission,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It took all that was left, and the catalogue could take no word any more."""
    undisturbed = submit(catalogue, admission)
    run(catalogue, settings, f"{undisturbed}-0")
    (sealed,) = (settings.data / "results").rglob("*.zip")
    size = sealed.stat().st_size
    small = settings.model_copy(update={"reserve": 4 * size})
    left = 0

    def room(one: Settings) -> int:
        """Return what a disk has beyond the reserve: too little from when results are sealed."""
        is_sealing = any(settings.data.glob("results/*/*.partial"))
        return (left if is_sealing else 2 * one.reserve) - one.reserve

    monkeypatch.setattr(Settings, "room", room)
    job = submit(catalogue, admission)
    left = 2 * size + 1
    run(catalogue, small, f"{job}-0")
    assert catalogue.get(job).activity == "waiting for room on the disk"
    assert not [*settings.data.rglob("*.partial")]
    left = 4 * size
    run(catalogue, small, f"{job}-0")
    assert [one.outcome for one in catalogue.attempts(job)] == ["put-off", "done"]
    same = stored(catalogue, settings, job), stored(catalogue, settings, undisturbed)
    assert same[0] == same[1]


def test_a_disk_that_gets_full_is_noticed_before_the_next_restart_point(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    """Many samples fill what is left for the catalogue meanwhile, which then takes no word."""
    rarely = settings.model_copy(update={"progress_period": 60.0})
    job = submit(catalogue, admission)
    claim = catalogue.claim_block(f"{job}-0", "this process", settings.lease)
    assert claim is not None
    computing = threading.Thread(
        target=BlockRun(catalogue, rarely, claim, threading.Event()).run, daemon=True
    )
    computing.start()
    until(settings.running_folder(job).exists)
    vars(rarely)["reserve"] = 2**60  # as if others had taken all
    computing.join()
    assert catalogue.get(job).activity == "waiting for room on the disk"


@pytest.mark.parametrize("lost", [held_by_another_program, out_of_reach, being_restored])
def test_a_catalogue_that_does_not_answer_is_waited_for(
    catalogue: Catalogue,
    settings: Settings,
    admission: Admission,
    lost: Callable[[Settings, Catalogue], AbstractContextManager[None]],
) -> None:
    job = submit(catalogue, admission)
    claim = catalogue.claim_block(f"{job}-0", "this process", settings.lease)
    assert claim is not None
    computing = threading.Thread(
        target=BlockRun(catalogue, settings, claim, threading.Event()).run, daemon=True
    )
    with lost(settings, catalogue):
        computing.start()
        sealed = settings.sealed_run(job, 1)  # it computes all of it meanwhile
        until(lambda: sealed.exists() or not computing.is_alive())
        computing.join(0.5)  # a few times as long as it waits before it asks again
        assert computing.is_alive()
    computing.join()
    stored(catalogue, settings, job)
    assert len(catalogue.attempts(job)) == 1


def test_rows_that_a_late_attempt_took_away_are_computed_again(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    undisturbed = submit(catalogue, admission)
    run(catalogue, settings, f"{undisturbed}-0")
    job = submit(catalogue, admission)
    run(catalogue, settings, f"{job}-0", draining=True)
    assert catalogue.blocks(job)[0].checkpoint is not None
    shutil.rmtree(settings.running_run(job, 1).folder)
    run(catalogue, settings, f"{job}-0")
    same = stored(catalogue, settings, job), stored(catalogue, settings, undisturbed)
    assert same[0] == same[1]


def test_an_attempt_that_comes_too_late_leaves_nothing(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    job = submit(catalogue, admission)
    late = catalogue.claim_block(f"{job}-0", "slow", lease=0.0)
    assert late is not None
    while not catalogue.reap(3).requeued:
        pass
    run(catalogue, settings, f"{job}-0")
    before = stored(catalogue, settings, job)
    late_run = BlockRun(catalogue, settings, late, threading.Event())
    late_run._report = lambda *_: block_run.Answer.go_on  # type: ignore[method-assign]
    late_run.run()  # it hears that the block is another's when it has sealed its own results
    assert stored(catalogue, settings, job) == before
    assert not settings.sealed_run(job, 1).exists()
    assert not settings.running_folder(job).exists()


def test_a_worker_that_shall_end_waits_for_a_catalogue_no_longer_than_its_lease(
    catalogue: Catalogue, settings: Settings, admission: Admission, monkeypatch: pytest.MonkeyPatch
) -> None:
    def away(*_: object) -> None:
        raise Unavailable("does not answer")

    job = submit(catalogue, admission)
    monkeypatch.setattr(catalogue, "release", away)
    with pytest.raises(Unavailable):
        run(
            catalogue,
            settings.model_copy(update={"lease": 0.2, "heartbeat": 0.05}),
            f"{job}-0",
            draining=True,
        )
    assert catalogue.get(job).state is JobState.running
