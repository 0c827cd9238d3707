import multiprocessing
import signal
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import NewJob, Verdict
from jointplay.storage.settings import Settings
from jointplay.worker.lease import Lease
from tests.waiting import until


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(data=tmp_path, lease=2.0, heartbeat=0.02)


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()


def new_block(catalogue: Catalogue) -> str:
    return f"{catalogue.submit(NewJob('simulate', {}, 'd' * 64, '1')).job.id}-0"


def lease_until(catalogue: Catalogue, block: str) -> float:
    found = catalogue.blocks(block.rsplit("-", 1)[0])[0].lease_until
    assert found is not None
    return found


def test_a_lease_is_extended_while_nothing_is_reported(
    catalogue: Catalogue, settings: Settings
) -> None:
    block = new_block(catalogue)
    claim = catalogue.claim_block(block, "worker", settings.lease)
    assert claim is not None
    with Lease(catalogue, claim, settings):
        for _ in range(3):
            before = lease_until(catalogue, block)
            until(lambda: lease_until(catalogue, block) > before)  # noqa: B023
    assert "heartbeat" not in {thread.name for thread in threading.enumerate()}


def test_losing_the_block_is_noticed(catalogue: Catalogue, settings: Settings) -> None:
    block = new_block(catalogue)
    claim = catalogue.claim_block(block, "worker", settings.lease)
    assert claim is not None
    with Lease(catalogue, claim, settings) as lease:
        assert lease.verdict() is Verdict.go_on
        catalogue.release(block, 1)
        with pytest.raises(Fenced):
            lease.record_progress(1.0, 0.5)


def test_a_lease_outlives_a_catalogue_that_is_being_restored(
    catalogue: Catalogue, settings: Settings, caplog: pytest.LogCaptureFixture
) -> None:
    block = new_block(catalogue)
    claim = catalogue.claim_block(block, "worker", settings.lease)
    assert claim is not None

    def rename(old: str, new: str) -> None:
        with catalogue.connections.writing() as connection:
            connection.exec_driver_sql(f"ALTER TABLE {old} RENAME TO {new}")

    with Lease(catalogue, claim, settings):
        rename("block", "away")
        until(lambda: f"heartbeat of block {block} failed" in caplog.text)
        rename("away", "block")
        before = lease_until(catalogue, block)
        until(lambda: lease_until(catalogue, block) > before)


def test_a_heartbeat_outlives_whatever_goes_wrong(
    catalogue: Catalogue, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    block = new_block(catalogue)
    claim = catalogue.claim_block(block, "worker", settings.lease)
    assert claim is not None
    wrong: list[str] = []
    heartbeat = catalogue.heartbeat

    def fails_twice(block_id: str, attempt: int, lease: float) -> Verdict:
        if len(wrong) < 2:
            wrong.append(block_id)
            raise ValueError("an answer that nobody expected")
        return heartbeat(block_id, attempt, lease)

    monkeypatch.setattr(catalogue, "heartbeat", fails_twice)
    before = lease_until(catalogue, block)
    with Lease(catalogue, claim, settings):
        until(lambda: lease_until(catalogue, block) > before)
    assert wrong == [block, block]


def hang(settings: Settings, block: str) -> None:
    catalogue = Catalogue(settings.catalogue_url)
    claim = catalogue.claim_block(block, "worker", settings.lease)
    assert claim is not None
    with Lease(catalogue, claim, settings):
        threading.Event().wait()


def test_a_process_that_does_not_advance_ends_itself(
    catalogue: Catalogue, settings: Settings
) -> None:
    impatient = settings.model_copy(update={"stall": 0.1})
    context = multiprocessing.get_context("spawn")
    process = context.Process(target=hang, args=(impatient, new_block(catalogue)))
    process.start()
    process.join()
    assert process.exitcode == -signal.SIGKILL
