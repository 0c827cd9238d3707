"""Results of jobs that expired are removed, and only theirs."""

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob
from jointplay.storage.settings import Settings
from jointplay.worker.removal import remove_expired

HOUR = 3600.0
NOW = [1_800_000_000.0]


class AskedMeanwhile(Catalogue):
    """Somebody asks for an expired job again, just after it was noted that its results may go."""

    def removable(self, limit: int, /) -> tuple[str, ...]:
        due = super().removable(limit)
        NOW[0] -= 1.0  # by a clock that is set back, or a little behind
        self.asked = self.submit(replace(NEW, expires=NOW[0] + HOUR), reuse=True)
        return due


NEW = NewJob("simulate", {"duration": 2.0, "scene": {}}, "d" * 64, "1", expires=NOW[0] + HOUR)


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(data=tmp_path)


@pytest.fixture
def done(settings: Settings) -> Iterator[str]:
    """A job with results, which has just expired."""
    NOW[0] = 1_800_000_000.0
    with closing(Catalogue(settings.catalogue_url, clock=lambda: NOW[0])) as catalogue:
        catalogue.migrate()
        job = catalogue.submit(NEW).job.id
        catalogue.claim_block(f"{job}-0", "worker", 30.0)
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))
        settings.sealed_run(job, 1).put([b"results"])
        NOW[0] += HOUR
        yield job


def test_an_expired_job_loses_its_results_for_good(settings: Settings, done: str) -> None:
    with closing(Catalogue(settings.catalogue_url, clock=lambda: NOW[0])) as catalogue:
        remove_expired(catalogue, settings)
        assert not settings.sealed_run(done, 1).exists()
        NOW[0] -= HOUR
        assert catalogue.expired(catalogue.get(done))


def test_a_job_that_is_found_again_meanwhile_keeps_its_results(
    settings: Settings, done: str
) -> None:
    """It was the answer to a request, and its results went a moment later."""
    with closing(AskedMeanwhile(settings.catalogue_url, clock=lambda: NOW[0])) as catalogue:
        remove_expired(catalogue, settings)
        assert (catalogue.asked.cached, catalogue.asked.job.id) == (True, done)
        assert settings.sealed_run(done, 1).exists()
        assert not catalogue.expired(catalogue.get(done))
