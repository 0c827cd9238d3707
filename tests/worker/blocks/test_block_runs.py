"""One block in this process, against a real catalogue: how it ends, whatever happens to it."""

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from one_block import run

from jointplay.records.point import PointStatus
from jointplay.solver.kernels import cache, kernel_cache, loop_code
from jointplay.solver.kernels.emit import module as emit_module
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob
from jointplay.storage.packed.reading import Packed
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader
from jointplay.worker import block_run, work
from jointplay.worker.block_run import BlockRun
from jointplay.worker.execute import Answer
from tests.solver.random_mechanisms import chain
from tests.stores import sealed_run

SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "seven-bar-press"},
    "grid": {"clearance": {"from": 2e-4, "to": 1e-3, "count": 12}},
    "periods": 10,
}


@pytest.fixture
def block(catalogue: Catalogue, admission: Admission) -> str:
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    return f"{catalogue.submit(new).job.id}-0"


@pytest.fixture
def study(catalogue: Catalogue) -> str:
    admitted = admit(SWEEP)
    assert isinstance(admitted, Study)
    new = NewJob(
        "sweep", admitted.job, admitted.digest, SOLVER_VERSION, blocks=admitted.blocks, seal=True
    )
    return catalogue.submit(new).job.id


def test_success_is_told_after_the_store_is_sealed(
    catalogue: Catalogue, settings: Settings, block: str, admission: Admission
) -> None:
    state, ended = run(catalogue, settings, block)
    assert (state, ended.state) == (JobState.succeeded, BlockState.done)
    job = catalogue.get(ended.job)
    assert (job.progress_time, job.progress_fraction) == (20.0, 1.0)
    reader = sealed_run(settings, job)
    reader.verify()
    assert reader.samples == admission.samples


def test_a_worker_told_to_stop_gives_its_block_back_with_a_restart_point(
    catalogue: Catalogue, settings: Settings, block: str
) -> None:
    state, released = run(catalogue, settings, block, draining=True)
    assert (state, released.state, released.losses) == (JobState.running, BlockState.queued, 0)
    assert released.checkpoint is not None
    state, ended = run(catalogue, settings, block)
    assert (state, ended.attempt) == (JobState.succeeded, 2)


@pytest.mark.parametrize("damage", ["cut", "flipped", "missing", "foreign"])
def test_a_restart_point_that_is_no_good_costs_time_only(
    catalogue: Catalogue, settings: Settings, block: str, damage: str
) -> None:
    _, released = run(catalogue, settings, block, draining=True)
    assert released.checkpoint is not None
    path = settings.running_folder(released.job) / released.checkpoint
    content = path.read_bytes()
    if damage == "cut":
        path.write_bytes(content[:-100])
    elif damage == "flipped":
        path.write_bytes(content[:-100] + bytes([content[-100] ^ 1]) + content[-99:])
    elif damage == "foreign":
        path.write_bytes(content.replace(SOLVER_VERSION.encode(), b"0.0.1+other"))
    else:
        path.unlink()
    state, ended = run(catalogue, settings, block)
    assert (state, ended.attempt) == (JobState.succeeded, 2)


def test_a_cancelled_blocks_store_is_closed_by_whoever_takes_it_over(
    catalogue: Catalogue, settings: Settings, block: str
) -> None:
    _, released = run(catalogue, settings, block, draining=True)
    assert catalogue.request_cancel(released.job).state is JobState.cancelling
    state, ended = run(catalogue, settings, block)
    assert (state, ended.state) == (JobState.cancelled, BlockState.cancelled)
    reader = sealed_run(settings, catalogue.get(ended.job))
    reader.verify()
    assert not reader.complete


def test_a_fenced_worker_leaves_without_a_word(
    catalogue: Catalogue, settings: Settings, block: str
) -> None:
    first = catalogue.claim_block(block, "slow", lease=0.0)
    assert first is not None
    while not catalogue.reap(3).requeued:
        pass
    state, ended = run(catalogue, settings, block)
    before = catalogue.events(ended.job)
    BlockRun(catalogue, settings, first, threading.Event()).run()
    assert catalogue.events(ended.job) == before
    assert catalogue.get(ended.job).state is state is JobState.succeeded
    sealed_run(settings, catalogue.get(ended.job)).verify()


def test_a_spec_this_solver_refuses_fails_as_the_users(
    catalogue: Catalogue, settings: Settings
) -> None:
    job = catalogue.submit(NewJob("simulate", {"kind": "simulate"}, "d" * 64, "0")).job.id
    state, _ = run(catalogue, settings, f"{job}-0")
    error = catalogue.get(job).error
    assert state is JobState.failed
    assert error is not None
    assert (error.error_class, error.code) == ("user", "invalid-input")
    assert "/scene" in error.detail


def test_a_study_succeeds_when_its_store_is_sealed(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    for index in (1, 0):
        state, ended = run(catalogue, settings, f"{study}-{index}")
        assert (state, ended.state) == (JobState.running, BlockState.done)
    reader = StudyReader(settings.running_study(study))
    assert (reader.status == 2).all()
    assert not reader.sealed
    state, ended = run(catalogue, settings, f"{study}-2")
    assert (state, ended.state) == (JobState.succeeded, BlockState.done)
    assert catalogue.get(study).progress_fraction == 1.0
    reader = StudyReader(Packed(settings.sealed_study(study)))
    reader.verify()
    assert reader.complete
    assert reader.peaks("displacement").maximum == pytest.approx(0.527, abs=0.003)


def test_a_block_given_back_goes_on_from_its_restart_point(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    state, released = run(catalogue, settings, f"{study}-0", draining=True)
    assert (state, released.state) == (JobState.running, BlockState.queued)
    assert released.checkpoint == "00000-a1"
    state, ended = run(catalogue, settings, f"{study}-0")
    assert (ended.state, ended.attempt) == (BlockState.done, 2)
    left = [path.name for path in (settings.running_study(study).folder / "parts").iterdir()]
    assert left == ["00000"]


def test_a_cancelled_study_keeps_what_it_computed(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    run(catalogue, settings, f"{study}-0")
    claim = catalogue.claim_block(f"{study}-1", "this process", settings.lease)
    assert claim is not None
    assert catalogue.request_cancel(study).state is JobState.cancelling
    BlockRun(catalogue, settings, claim, threading.Event()).run()
    assert catalogue.get(study).state is JobState.cancelled
    assert catalogue.claim_block(f"{study}-2", "this process", 30) is None
    reader = StudyReader(settings.running_study(study))
    ended, stopped = reader.status[:8], reader.status[8:]
    assert (ended == PointStatus.done).all()
    assert (stopped <= PointStatus.running).all()  # at a report: before or behind a first slice
    assert not reader.complete


def test_part_of_a_study_by_another_solver_is_not_mixed_with_ours(
    catalogue: Catalogue, settings: Settings, study: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(catalogue, settings, f"{study}-0")
    running = settings.running_study(study)
    layout = StudyReader(running).attributes["layout"]
    documents = {key: running.read(key) for key in running}
    root = documents["zarr.json"].replace(layout.encode(), b"of another version")
    running.write_documents((documents | {"zarr.json": root}).items())
    state, _ = run(catalogue, settings, f"{study}-1")
    error = catalogue.get(study).error
    assert state is JobState.failed
    assert error is not None
    assert (error.error_class, error.code) == ("platform", "storage")
    assert "submit the study again" in error.detail


def test_a_study_is_admitted_once_by_a_process(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    run(catalogue, settings, f"{study}-0")
    first = work._last_study
    assert first is not None
    for index in (1, 2):
        run(catalogue, settings, f"{study}-{index}")
        assert work._last_study is first
    assert catalogue.get(study).state is JobState.succeeded


def test_what_takes_long_before_anything_advances_is_said_to_compile(
    catalogue: Catalogue, settings: Settings, study: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(block_run, "_LONG", 0.0)
    run(catalogue, settings, f"{study}-1")
    (event,) = [event for event in catalogue.events(study) if event.type == "compiling"]
    assert event.data == {"block": f"{study}-1", "attempt": 1}
    assert catalogue.get(study).activity is None  # it advanced


def test_what_a_worker_sealed_before_it_was_lost_is_adopted(
    catalogue: Catalogue, settings: Settings, block: str
) -> None:
    """Killed between sealing and saying so: the next attempt has nothing left to compute."""
    lost = catalogue.claim_block(block, "killed", lease=0.0)
    assert lost is not None
    work.work_of(lost, settings).execute(lambda _: Answer.go_on, lambda: None)
    sealed = settings.sealed_run(lost.job.id, 1)
    content = sealed.read(0, sealed.size())
    while not catalogue.reap(3).requeued:
        pass
    state, ended = run(catalogue, settings, block)
    assert (state, ended.attempt) == (JobState.succeeded, 2)
    job = catalogue.get(lost.job.id)
    assert (job.progress_time, job.progress_fraction) == (20.0, 1.0)
    assert job.steps == sealed_run(settings, job).attributes["summary"]["steps"]
    adopted = settings.sealed_run(job.id, 2)
    assert adopted.read(0, adopted.size()) == content  # with the seconds that the first one took
    assert not sealed.exists()
    assert not settings.running_folder(job.id).exists()


@contextmanager
def undone(catalogue: Catalogue, settings: Settings) -> Iterator[None]:
    """Put the catalogue back at the end as it is now, as from a backup or by a power cut."""
    file, copy = settings.data / "catalogue.sqlite", settings.data / "copy.sqlite"
    with closing(sqlite3.connect(file)) as one, closing(sqlite3.connect(copy)) as other:
        one.backup(other)
    yield
    catalogue.close()
    for left in settings.data.glob(f"{file.name}?*"):
        left.unlink()
    copy.replace(file)


@pytest.mark.parametrize("answer", [Answer.go_on, Answer.cancel, None])
def test_what_an_attempt_left_whose_claim_was_undone_is_in_nobodys_way(
    catalogue: Catalogue, settings: Settings, block: str, answer: Answer | None
) -> None:
    """Its next claim has the same number: whole results are taken, all else is made anew."""
    job = catalogue.blocks(block.rpartition("-")[0])[0].job
    sealed = settings.sealed_run(job, 1)
    content = None
    with undone(catalogue, settings):
        if answer is None:
            run(catalogue, settings, block, draining=True)
            assert settings.running_run(job, 1).folder.exists()
        else:
            lost = catalogue.claim_block(block, "lost", lease=0.0)
            assert lost is not None
            work.work_of(lost, settings).execute(lambda _: answer, lambda: None)
            content = sealed.read(0, sealed.size())
    assert catalogue.blocks(job)[0].attempt == 0
    state, ended = run(catalogue, settings, block)
    assert (state, ended.attempt) == (JobState.succeeded, 1)
    assert sealed_run(settings, catalogue.get(job)).complete
    assert (sealed.read(0, sealed.size()) == content) is (answer is Answer.go_on)
    assert not settings.running_folder(job).exists()


@pytest.mark.parametrize("damaged", [False, True])
def test_a_study_that_was_sealed_is_not_computed_again_where_the_catalogue_is_an_older_one(
    catalogue: Catalogue,
    settings: Settings,
    study: str,
    monkeypatch: pytest.MonkeyPatch,
    damaged: bool,
) -> None:
    sealed = settings.sealed_study(study)
    path = settings.data / "results" / sealed.key
    blocks = [f"{study}-{index}" for index in range(len(catalogue.blocks(study)))]
    with undone(catalogue, settings):
        for block in blocks:
            run(catalogue, settings, block)
        content = path.read_bytes()
        if damaged:
            path.write_bytes(content[:2000] + b"?" + content[2001:])
    computed: list[int] = []
    compute = work.run_block
    monkeypatch.setattr(
        work, "run_block", lambda *given, **of: computed.append(1) or compute(*given, **of)
    )
    for block in blocks:
        run(catalogue, settings, block)
    assert catalogue.get(study).state is JobState.succeeded
    assert path.read_bytes() == content
    assert bool(computed) is damaged
    assert not settings.running_folder(study).exists()


SEVERAL_BODIES = {"kind": "simulate", "scene": chain(10).model_dump(mode="json"), "duration": 0.1}


@pytest.fixture
def compiling(catalogue: Catalogue, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A block whose kernel is in no cache, and takes seconds to compile."""
    monkeypatch.setattr(kernel_cache, "_kernels", {})
    folder = tmp_path / "kernels"
    folder.mkdir()
    for module in (cache, loop_code, emit_module):
        monkeypatch.setattr(module, "cache_folder", lambda: folder)
    loop_code.path_of(loop_code.FOR_RUNS).touch()
    admitted = admit(SEVERAL_BODIES)
    new = NewJob("simulate", admitted.job, admitted.digest, SOLVER_VERSION)
    return f"{catalogue.submit(new).job.id}-0"


def test_a_job_can_be_cancelled_while_its_equations_are_compiled(
    catalogue: Catalogue, settings: Settings, compiling: str
) -> None:
    job = compiling.rpartition("-")[0]
    claim = catalogue.claim_block(compiling, "this process", settings.lease)
    assert claim is not None
    catalogue.request_cancel(job)
    BlockRun(catalogue, settings, claim, threading.Event()).run()
    assert catalogue.get(job).state is JobState.cancelled
    assert not list(cache.cache_folder().glob("jointplay.*.o"))


def test_a_worker_told_to_stop_gives_back_a_block_that_it_compiles(
    catalogue: Catalogue, settings: Settings, compiling: str
) -> None:
    state, released = run(catalogue, settings, compiling, draining=True)
    assert (state, released.state, released.losses) == (JobState.running, BlockState.queued, 0)


def test_equations_that_take_too_long_to_compile_fail_with_the_limit(
    catalogue: Catalogue, settings: Settings, compiling: str
) -> None:
    impatient = settings.model_copy(update={"longest_compilation": 0.1})
    state, ended = run(catalogue, impatient, compiling)
    error = catalogue.get(ended.job).error
    assert state is JobState.failed
    assert error is not None
    assert (error.error_class, error.code) == ("limit", "compile-time")
    assert "bodies" in error.detail
