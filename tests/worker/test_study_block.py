"""Blocks of a real study into a real store, as workers and local runs compute them."""

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from jointplay.solver.kinds import Study, admit
from jointplay.storage.errors import IncompleteStudy, StoreExists
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create, seal
from jointplay.worker.execute import Answer, Outcome, Progress
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from tests.stores import packed, target
from tests.worker.answers import after

PARAMETERS = {"clearance": 5e-4, "friction": 0.1, "stiffness": 5e9}
JOB = {
    "kind": "bifurcation",
    "scene": {"preset": "seven-bar-press", "parameters": PARAMETERS},
    "parameter": "clearance",
    "values": {"from": 2e-4, "to": 1e-3, "count": 12},
    "settle": 2,
    "record": 30,
}


def admitted(job: dict[str, object]) -> Study:
    study = admit(job)
    assert isinstance(study, Study)
    return study


@pytest.fixture(scope="module")
def study() -> Study:
    return admitted(JOB)


@pytest.fixture(scope="module")
def undisturbed(study: Study, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(study, tmp_path_factory.mktemp("undisturbed") / "store")


def write(study: Study, folder: Path) -> Path:
    for index in range(len(study.blocks)):
        assert run_block(study, index, folder).state == "succeeded"
    seal(folder, layout_of_study(study), target(folder))
    return packed(folder)


def test_a_study_is_readable_and_repeats_itself_from_its_job_file(
    study: Study, undisturbed: Path, tmp_path: Path
) -> None:
    reader = StudyReader(undisturbed)
    reader.verify()
    assert (reader.complete, reader.kind, reader.points, reader.record) == (
        True,
        "bifurcation",
        12,
        30,
    )
    assert (
        reader.statistics.keys() | reader.indicators.keys() <= layout_of_study(study).outputs.keys()
    )
    assert reader.attributes["job"] == study.job
    assert reader.attributes["digest"] == study.digest
    assert [(spec.name, spec.unit) for spec in reader.parameters] == [("clearance", "m")]
    np.testing.assert_array_equal(reader.values, study.values)
    assert (reader.status == 2).all()
    assert (reader.counts == 30).all()
    # a section at each whole turn of the crank, the first after two of them
    turns = np.arange(3, 33) * study.period[:, None]
    np.testing.assert_allclose(reader.section_times(), turns, rtol=1e-14)
    # the journal stays in its clearance but for the penetration, some micrometres
    eccentricity = np.hypot(
        reader.sections("A.eccentricity_x"), reader.sections("A.eccentricity_y")
    )
    assert (eccentricity < reader.values + 2e-5).all()
    assert (reader.statistics["steps"] > 100).all()
    again = admitted(StudyReader(undisturbed).attributes["job"])
    assert write(again, tmp_path / "again").read_bytes() == undisturbed.read_bytes()


def test_the_bits_do_not_depend_on_processes_or_the_order_of_blocks(
    study: Study, undisturbed: Path, tmp_path: Path
) -> None:
    create(tmp_path / "store", layout_of_study(study))
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        running = [
            pool.submit(run_block, study, index, tmp_path / "store")
            for index in reversed(range(len(study.blocks)))
        ]
        assert {run.result().state for run in running} == {"succeeded"}
    seal(tmp_path / "store", layout_of_study(study), target(tmp_path / "store"))
    assert packed(tmp_path / "store").read_bytes() == undisturbed.read_bytes()


def test_however_often_a_block_is_left_and_resumed_the_bytes_are_the_same(
    study: Study, undisturbed: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "store"
    for index in range(len(study.blocks)):
        names: list[str] = []
        fractions: list[float] = []
        resume_from = None
        for attempt in (1, 2, 3):
            report = after(attempt, Answer.leave, names)
            outcome = run_block(
                study, index, folder, report=report, attempt=attempt, resume_from=resume_from
            )
            assert outcome.state == "left"
            fractions.append(outcome.fraction)
            resume_from = (names[-1], outcome.fraction)
        assert 0 < fractions[0] < fractions[1] < fractions[2] < 1
        assert run_block(study, index, folder, attempt=4, resume_from=resume_from) == Outcome(
            "succeeded", 0.0, 1.0
        )
    seal(folder, layout_of_study(study), target(folder))
    assert packed(folder).read_bytes() == undisturbed.read_bytes()


def test_steps_of_a_resumed_block_are_those_of_all_its_points(study: Study, tmp_path: Path) -> None:
    kept: list[tuple[str, float]] = []

    def leave_amid(progress: Progress) -> Answer:
        if not 0 < progress.watermark < study.blocks[0][1]:
            return Answer.go_on
        kept.append((progress.keep()[0], progress.fraction))
        return Answer.leave

    folder = tmp_path / "store"
    assert run_block(study, 0, folder, report=leave_amid).state == "left"
    told: list[int] = []

    def listen(progress: Progress) -> Answer:
        told.append(progress.steps())
        return Answer.go_on

    outcome = run_block(study, 0, folder, report=listen, attempt=2, resume_from=kept[0])
    first, count = study.blocks[0]
    steps = StudyReader(folder).statistics["steps"][first : first + count]
    assert outcome.statistics == {"steps": steps.sum()}
    assert 0 < told[0] < steps.sum()


def test_a_worker_lost_between_a_cancelled_block_and_the_word_of_it_costs_nothing_else(
    study: Study, tmp_path: Path
) -> None:
    names: list[str] = []
    ended = run_block(study, 0, tmp_path / "store", report=after(1, Answer.cancel, names))
    assert ended.state == "cancelled"
    again = run_block(
        study,
        0,
        tmp_path / "store",
        report=after(0, Answer.cancel, []),
        attempt=2,
        resume_from=(names[-1], ended.fraction),
    )
    assert again.state == "cancelled"


def test_a_restart_point_that_is_no_good_costs_time_only(
    study: Study, undisturbed: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "store"
    names: list[str] = []
    run_block(study, 0, folder, report=after(1, Answer.leave, names))
    path = folder / "parts" / names[0]
    path.write_bytes(path.read_bytes()[:-100])
    assert run_block(study, 0, folder, attempt=2, resume_from=(names[0], 0.1)).state == "succeeded"
    assert (
        run_block(study, 1, folder, attempt=2, resume_from=("00001-a1", 0.1)).state == "succeeded"
    )
    seal(folder, layout_of_study(study), target(folder))
    assert packed(folder).read_bytes() == undisturbed.read_bytes()


def test_a_block_that_is_done_is_not_computed_again(study: Study, tmp_path: Path) -> None:
    assert run_block(study, 1, tmp_path).state == "succeeded"

    def report(progress: Progress) -> str:
        raise AssertionError("nothing is to be computed")

    assert run_block(study, 1, tmp_path, report=report, attempt=2).state == "succeeded"


def test_a_cancelled_block_keeps_what_it_computed(study: Study, tmp_path: Path) -> None:
    def report(progress: Progress) -> Answer:
        return Answer.cancel if progress.fraction > 0.4 else Answer.go_on

    outcome = run_block(study, 0, tmp_path, report=report)
    assert outcome.state == "cancelled"
    reader = StudyReader(tmp_path)
    assert not reader.complete
    assert (reader.status[:8] >= 1).all()
    assert set(reader.status[8:]) == {0}
    assert (reader.counts[:8] > 0).all()
    found = reader.sections("slider7.x")
    assert np.isfinite(found).sum() == reader.counts.sum()
    with pytest.raises(IncompleteStudy):
        seal(tmp_path, layout_of_study(study), target(tmp_path))


def test_a_block_that_computes_too_long_fails_with_what_it_has(
    study: Study, tmp_path: Path
) -> None:
    outcome = run_block(study, 0, tmp_path, longest=0.0)
    assert outcome.state == "failed"
    assert outcome.error is not None
    assert (outcome.error.error_class, outcome.error.code) == ("limit", "time-limit")
    assert 0.0 < outcome.fraction < 1.0
    reader = StudyReader(tmp_path)
    assert not reader.complete
    assert (reader.status > 0).any()


def test_a_point_that_fails_leaves_the_others_standing(tmp_path: Path) -> None:
    # friction that turns round within 1e-12 m/s, at a tolerance near the rounding of doubles
    parameters = {"static_velocity": 1e-12, "dynamic_velocity": 2e-12}
    study = admitted(
        {
            "kind": "sweep",
            "scene": {"preset": "seven-bar-press", "parameters": parameters},
            "points": [{"friction": 1.0}, {"friction": 0.0}, {"friction": 0.5}],
            "periods": 1,
            "tolerance": 1e-13,
        }
    )
    reader = StudyReader(write(study, tmp_path / "store"))
    assert reader.status.tolist() == [3, 2, 3]
    assert reader.failures.keys() == {0, 2}
    failure = reader.failures[0]
    assert failure.code == "step-size-underflow"
    assert "Try a larger tolerance" in failure.detail
    assert 0 < failure.time < 2
    assert reader.attributes["summary"] == {"done": 1, "failed": 2}
    peaks = reader.peaks("displacement")
    assert peaks.maximum[1] == pytest.approx(0.527, abs=0.002)  # press, clearance 0.5 mm


def test_results_of_something_else_are_never_written_over(study: Study, tmp_path: Path) -> None:
    other = admitted(JOB | {"record": 31})
    create(tmp_path, layout_of_study(other))
    with pytest.raises(StoreExists):
        run_block(study, 0, tmp_path)
