"""Bytes that count against a quota: those of sealed results, or of what a job left without them."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob
from jointplay.storage.settings import Settings
from jointplay.worker.measuring import measure_results

NEW = NewJob("simulate", {}, "d" * 64, "1", owner="ada")
ERROR = JobError("solver", "step-limit", "it took too many steps")


@pytest.fixture(params=["data", "results"])
def settings(request: pytest.FixtureRequest, tmp_path: Path) -> Settings:
    return Settings(data=tmp_path, running=request.param)


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()


def test_what_a_failed_job_left_counts_unless_it_goes(
    catalogue: Catalogue, settings: Settings
) -> None:
    unsealed, sealed, study = (catalogue.submit(NEW).job.id for _ in range(3))
    for job in (unsealed, sealed, study):
        assert catalogue.claim_block(f"{job}-0", "worker", 60.0)
        settings.running_files(job).put("a1/documents", [b"documents"])
        settings.running_files(job).put("a1/rows/history-0.zip", [b"rows"])
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.failed, ERROR))
    settings.sealed_run(sealed, 1).put([b"results"])
    settings.sealed_study(study).put([b"points"])
    measure_results(catalogue, settings)
    assert [catalogue.get(job).stored for job in (unsealed, sealed, study)] == [13, 7, 6]
    assert catalogue.use_of("ada").stored == 26


def test_a_job_that_cannot_be_measured_keeps_no_others_from_it(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, running="data")
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    odd, other = (catalogue.submit(NEW).job.id for _ in range(2))
    for job in (odd, other):
        assert catalogue.claim_block(f"{job}-0", "worker", 60.0)
        settings.running_files(job).put("a1/documents", [b"documents"])
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.failed, ERROR))
    (settings.running_folder(odd) / "a1" / "rows").symlink_to("nowhere")
    measure_results(catalogue, settings)
    assert [catalogue.get(job).stored for job in (odd, other)] == [None, 9]
    catalogue.close()
