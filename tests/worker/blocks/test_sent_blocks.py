"""Blocks that are computed in a folder of their own: what others need is in the object store.

Each attempt's folder goes when it ends, as it would with its machine.
"""

import threading
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_block_runs import SWEEP

from jointplay.service.app import create_app
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, BlockState, JobState, NewJob, Verdict
from jointplay.storage.identity import growing_study
from jointplay.storage.installation import MARK
from jointplay.storage.object_stores import ObjectStore, StoredObject
from jointplay.storage.packed.reading import Packed
from jointplay.storage.reconciliation.leftovers import left_after
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader
from jointplay.worker import block_run
from jointplay.worker.execute import execute
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from jointplay.worker.joined.protocol import Document
from jointplay.worker.scratch.computing import compute
from tests.seaweedfs_server import BUCKET, running_store
from tests.service_in_thread import serving
from tests.stores import files_of, packed, sealed_run, target
from tests.waiting import until

# steps of so many samples fill files of rows between restart points
JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 30.0,
    "output_step": 2e-3,
    "channels": ["slider7.*"],
    "certificate": False,
}


class MachineLost(BaseException):
    """Ends an attempt where a machine without power would: nothing more is computed or sent."""


class ShortOfPower(Catalogue):
    """The catalogue as a machine sees it that is lost behind a restart point in mid-run."""

    named = False

    def record_checkpoint(
        self, block_id: str, attempt: int, /, *, watermark: int, checkpoint: str
    ) -> None:
        super().record_checkpoint(block_id, attempt, watermark=watermark, checkpoint=checkpoint)
        self.named = watermark > 0

    def record_progress(self, *given: Any, **named: Any) -> Verdict:
        if self.named:
            raise MachineLost
        return super().record_progress(*given, **named)


@pytest.fixture(scope="module", params=["file", pytest.param("s3", marks=pytest.mark.long)])
def address(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    if request.param == "file":
        yield f"file:{tmp_path_factory.mktemp('results')}"
        return
    with running_store() as endpoint:
        yield f"s3://{BUCKET}/sent?endpoint={endpoint}"


@pytest.fixture
def settings(tmp_path: Path, address: str, monkeypatch: pytest.MonkeyPatch) -> Settings:
    for name in ("_MOST_OVERHEAD", "_MOST_WAITING"):
        monkeypatch.setattr(block_run, name, 0)  # a restart point with every slice
    return Settings(data=tmp_path, results_url=address, running="results", progress_period=1e-3)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("undisturbed") / "store"
    admission = admit(JOB)
    assert isinstance(admission, Admission)
    assert (
        execute(admission, folder, target(folder), report=lambda _: "continue").state == "succeeded"
    )
    return packed(folder)


def attempt(catalogue: Catalogue, settings: Settings, block: str) -> None:
    claim = catalogue.claim_block(block, "this process", settings.lease)
    assert claim is not None
    compute(catalogue, settings, claim, threading.Event())


def submit(catalogue: Catalogue, document: dict[str, object]) -> str:
    admitted = admit(document)
    more = {"blocks": admitted.blocks, "seal": True} if isinstance(admitted, Study) else {}
    new = NewJob(str(document["kind"]), admitted.job, admitted.digest, SOLVER_VERSION, **more)
    return catalogue.submit(new).job.id


def chunks(store: Path | StoredObject) -> dict[str, bytes]:
    measured = "statistics/seconds/"
    found = files_of(store).items()
    return {key: some for key, some in found if "/c/" in key and not key.startswith(measured)}


class Called(Connection):
    """A worker's connection to a service; the worker shall end after its first restart point."""

    def __init__(self, url: str) -> None:
        super().__init__(url, None)
        self.away = threading.Event()

    def report(
        self,
        block: Block,
        what: str,
        document: Document | None = None,
        *,
        within: float | None = None,
    ) -> bytes:
        answer = super().report(block, what, document, within=within)
        if what == "checkpoint":
            self.away.set()
        return answer


@pytest.mark.parametrize("address", ["s3"], indirect=True)
def test_workers_that_know_the_service_alone_go_on_from_one_another_in_its_place(
    settings: Settings, catalogue: Catalogue, undisturbed: Path
) -> None:
    job = submit(catalogue, JOB)
    with serving(create_app(settings)) as url:
        with closing(Called(url)) as first:
            assert work(first, first.away, None) == 1
        (block,) = catalogue.blocks(job)
        assert (block.state, block.checkpoint is not None) == (BlockState.queued, True)
        assert [*settings.object_store.list("running/")]
        assert not settings.running_folder(job).exists()
        with closing(Connection(url, None)) as second:
            assert work(second, threading.Event(), 0.5) == 1
    ended = catalogue.get(job)
    assert (ended.state, ended.attempt) == (JobState.succeeded, 2)
    assert chunks(settings.sealed_run(job, 2)) == chunks(undisturbed)
    left = {*settings.object_store.list("")} - {"installation"}  # whose catalogue it belongs to
    assert left == {settings.sealed_run(job, 2).key}
    settings.object_store.remove(settings.results_prefix(job))


def test_another_machine_goes_on_from_what_a_lost_one_had_sent(
    settings: Settings, catalogue: Catalogue, undisturbed: Path
) -> None:
    job = submit(catalogue, JOB)
    losing = ShortOfPower(settings.catalogue_url)
    short = settings.model_copy(update={"lease": 0.2, "heartbeat": 0.1})
    with pytest.raises(MachineLost):
        attempt(losing, short, f"{job}-0")
    losing.close()
    assert not settings.running_folder(job).exists()
    assert all(
        "rows/" not in key or "/a1/" in key for key in settings.object_store.list("running/")
    )
    (block,) = catalogue.blocks(job)
    growing = ResultReader(settings.running_run(job, 1), block.watermark)
    expected = ResultReader(undisturbed)
    assert 0 < growing.samples == block.watermark < expected.samples
    for name, column in growing.history()[1].items():
        np.testing.assert_array_equal(column, expected.history([name])[1][name][: growing.samples])
    until(lambda: bool(catalogue.reap(3).requeued))
    attempt(catalogue, settings, f"{job}-0")
    ended = catalogue.get(job)
    assert (ended.state, ended.attempt) == (JobState.succeeded, 2)
    stored = chunks(settings.sealed_run(job, 2))
    assert stored == chunks(undisturbed)
    assert len(stored) > 20
    assert sealed_run(settings, ended).attributes["summary"]["steps"] == ended.steps
    left = {*settings.object_store.list("")} - {"installation"}  # whose catalogue it belongs to
    assert left == {settings.sealed_run(job, 2).key}
    settings.object_store.remove(settings.results_prefix(job))


def kept_in(store: ObjectStore) -> list[str]:
    """List the objects of an object store but the mark of its installation, which a bucket has."""
    return [key for key in store.list("") if key != MARK]


def test_blocks_of_a_study_meet_in_the_object_store(
    settings: Settings, catalogue: Catalogue
) -> None:
    study = submit(catalogue, SWEEP)
    for index in (1, 0):
        attempt(catalogue, settings, f"{study}-{index}")
    growing = growing_study(settings, catalogue, study)
    assert (growing.status == 2).all()
    assert not growing.sealed
    attempt(catalogue, settings, f"{study}-2")
    assert catalogue.get(study).state is JobState.succeeded
    reader = StudyReader(Packed(settings.sealed_study(study)))
    reader.verify()
    np.testing.assert_array_equal(reader.peaks("displacement"), growing.peaks("displacement"))
    assert kept_in(settings.object_store) == [settings.sealed_study(study).key]
    settings.object_store.remove(settings.results_prefix(study))


def test_what_a_short_run_needs_is_one_object(settings: Settings, catalogue: Catalogue) -> None:
    patient = settings.model_copy(update={"progress_period": 600.0})
    put: list[str] = []
    store = settings.object_store
    job = submit(catalogue, JOB | {"duration": 4.0})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(type(store), "replace", lambda *given: put.append(given[1]))
        attempt(catalogue, patient, f"{job}-0")
    assert put == []
    assert kept_in(store) == [settings.sealed_run(job, 1).key]
    store.remove(settings.results_prefix(job))


def test_what_a_late_attempt_left_is_found_and_removed(
    settings: Settings, catalogue: Catalogue
) -> None:
    job = submit(catalogue, JOB | {"duration": 4.0})
    attempt(catalogue, settings, f"{job}-0")
    settings.running_files(job).put("a1/rows/history-0.zip", [b"late"])
    settings.running_files("0" * 26).put("block0-a1", [b"of no job"])
    left = {one.subject: one for one in left_after(settings, catalogue, 0.0)}
    named = f"running/{job[-2:]}/{job}"
    assert left.keys() == {named, f"running/00/{'0' * 26}"}
    mend = left[named].mend
    assert mend is not None
    mend()
    settings.running_files("0" * 26).clear()
    assert kept_in(settings.object_store) == [settings.sealed_run(job, 1).key]
    settings.object_store.remove(settings.results_prefix(job))
