"""Files that are damaged while a job runs: its worker computes again what was lost."""

import shutil
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState, NewJob
from jointplay.storage.settings import Settings
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.store import create, seal
from jointplay.worker.block_run import BlockRun
from jointplay.worker.execute import execute
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from jointplay.worker.work import SimulationWork
from tests.stores import files_of, target

LONG = {
    "kind": "simulate",
    "scene": {"preset": "pendulum"},
    "duration": 5.6,
    "output_step": 1e-5,  # with so many samples one file of extremes is full before the end
    "channels": ["rod.theta"],
    "certificate": False,
}
STUDY = {
    "kind": "sweep",
    "scene": {"preset": "seven-bar-press"},
    "grid": {"clearance": {"from": 2e-4, "to": 1e-3, "count": 12}},
    "periods": 3,
}


def flipped(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 8
    path.write_bytes(content)


def truncated(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-9])


DAMAGES: list[Callable[[Path], None]] = [flipped, truncated, Path.unlink]


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(data=tmp_path / "data", progress_period=1e-3)


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    settings.data.mkdir()
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()


def run(catalogue: Catalogue, settings: Settings, block: str) -> JobState:
    claim = catalogue.claim_block(block, "this process", settings.lease)
    assert claim is not None
    BlockRun(catalogue, settings, claim, threading.Event()).run()
    return catalogue.get(claim.job.id).state


@pytest.mark.parametrize("damage", DAMAGES[:2])
def test_rows_of_a_run_that_are_damaged_before_it_is_sealed_are_computed_again(
    catalogue: Catalogue, settings: Settings, damage: Callable[[Path], None]
) -> None:
    admission = admit(LONG)
    assert isinstance(admission, Admission)
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    job = catalogue.submit(new).job.id
    claim = catalogue.claim_block(f"{job}-0", "this process", settings.lease)
    assert claim is not None
    struck: list[Path] = []

    def strike(_: object) -> str:
        found = sorted(settings.running_run(job, 1).folder.glob("rows/*"))
        if found and not struck:
            damage(found[0])
            struck.append(found[0])
        return "continue"

    work = SimulationWork(admission, claim, settings)
    assert work.execute(strike, lambda: None).state == "succeeded"
    assert struck
    untouched = settings.sealed_run("untouched", 1)
    folder = settings.running_run("untouched", 1).folder
    execute(admission, folder, untouched, report=lambda _: "continue")
    found, expected = (files_of(one) for one in (settings.sealed_run(job, 1), untouched))
    for files in (found, expected):  # what it cost in seconds is in these
        del files["zarr.json"], files["MANIFEST.json"]
    assert found == expected


def test_what_was_sealed_before_is_looked_at_file_by_file(
    catalogue: Catalogue, settings: Settings
) -> None:
    """A large one takes longer than a worker may stand still."""
    admission = admit({**LONG, "duration": 0.1})
    assert isinstance(admission, Admission)
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    job = catalogue.submit(new).job.id
    claim = catalogue.claim_block(f"{job}-0", "this process", settings.lease)
    assert claim is not None
    work = SimulationWork(admission, claim, settings)
    assert work.execute(lambda _: "continue", lambda: None).state == "succeeded"
    advanced: list[bool] = []
    computed: list[object] = []
    ended = work.execute(computed.append, lambda: advanced.append(True))  # type: ignore[arg-type]
    assert (ended.state, computed) == ("succeeded", [])
    listed = files_of(settings.sealed_run(job, 1)).keys() - {"MANIFEST.json"}
    assert len(advanced) == len(listed)


@pytest.fixture(scope="module")
def study() -> Study:
    study = admit(STUDY)
    assert isinstance(study, Study)
    return study


@pytest.fixture(scope="module")
def undisturbed(study: Study, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Files of the study's store when nothing happens to it."""
    folder = tmp_path_factory.mktemp("undisturbed") / "study"
    for index in range(len(study.blocks)):
        run_block(study, index, folder)
    seal(folder, layout_of_study(study), target(folder))
    return files_of(target(folder))


def submitted(catalogue: Catalogue, study: Study) -> str:
    new = NewJob(
        study.job["kind"], study.job, study.digest, SOLVER_VERSION, blocks=study.blocks, seal=True
    )
    return catalogue.submit(new).job.id


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("file", ["parts/00000", "documents.zip"])
def test_what_a_block_left_and_is_damaged_is_computed_again(
    catalogue: Catalogue,
    settings: Settings,
    study: Study,
    undisturbed: dict[str, bytes],
    file: str,
    damage: Callable[[Path], None],
) -> None:
    job = submitted(catalogue, study)
    for index in range(len(study.blocks)):
        run(catalogue, settings, f"{job}-{index}")
    damage(settings.running_study(job).folder / file)
    assert run(catalogue, settings, f"{job}-{len(study.blocks)}") is JobState.succeeded
    assert files_of(settings.sealed_study(job)) == undisturbed


@pytest.mark.parametrize("file", ["parts/00000", "documents.zip"])
def test_what_is_exchanged_with_another_jobs_is_computed_again(
    catalogue: Catalogue,
    settings: Settings,
    study: Study,
    undisturbed: dict[str, bytes],
    tmp_path: Path,
    file: str,
) -> None:
    other = admit(STUDY | {"periods": 2})
    assert isinstance(other, Study)
    create(tmp_path, layout_of_study(other))
    part = StudyBlock(tmp_path, layout_of_study(other), 0).flush(b"")
    (tmp_path / "parts" / part).rename(tmp_path / "parts/00000")
    job = submitted(catalogue, study)
    run(catalogue, settings, f"{job}-0")
    shutil.copy(tmp_path / file, settings.running_study(job).folder / file)
    for index in range(1, len(study.blocks) + 1):
        run(catalogue, settings, f"{job}-{index}")
    assert catalogue.get(job).state is JobState.succeeded
    assert files_of(settings.sealed_study(job)) == undisturbed
