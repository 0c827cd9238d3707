from pathlib import Path

import pytest

from jointplay.solver.kinds import Admission, admit
from jointplay.storage.errors import StoreExists
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.execute import Answer, Outcome, execute
from tests.stores import files_of, target
from tests.worker.answers import after

JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 60.0,
    "output_step": 1e-3,
    "channels": ["slider7.*", "A.*"],
}


@pytest.fixture(scope="module")
def admission() -> Admission:
    return admit(JOB)


def arrays(store: Path) -> dict[str, bytes]:
    return {key: content for key, content in files_of(store).items() if "/" in key}


def run(admission: Admission, folder: Path, resume_from: str | None = None) -> Outcome:
    return execute(
        admission,
        folder,
        target(folder),
        report=lambda _: "continue",
        resume_from=resume_from,
    )


def test_a_store_repeats_itself_from_its_job_file(admission: Admission, tmp_path: Path) -> None:
    assert run(admission, tmp_path / "first").state == "succeeded"
    again = admit(ResultReader(tmp_path / "first.zip").attributes["job"])
    assert run(again, tmp_path / "again").state == "succeeded"
    assert arrays(tmp_path / "first.zip") == arrays(tmp_path / "again.zip")
    reader = ResultReader(tmp_path / "first.zip")
    assert reader.complete
    assert reader.attributes["job"] == admission.job
    assert reader.attributes["digest"] == admission.digest
    time, values = reader.history(["slider7.x"])
    assert len(time) == admission.samples
    assert time[-1] == 60.0
    assert values["slider7.x"].min() > 1.4  # the slide of the press stays beyond its cranks


def test_however_often_it_is_left_and_resumed_the_bits_are_the_same(
    admission: Admission, tmp_path: Path
) -> None:
    assert run(admission, tmp_path / "undisturbed").state == "succeeded"
    names: list[str] = []
    fractions: list[float] = []
    resume_from = None
    for leg in range(3):
        report = after(1 + leg, Answer.leave, names)
        folder = tmp_path / f"a{leg}"
        outcome = execute(admission, folder, target(folder), report=report, resume_from=resume_from)
        assert outcome.state == "left"
        fractions.append(outcome.fraction)
        resume_from = names[-1]
    assert 0 < fractions[0] < fractions[1] < fractions[2] < 1
    assert run(admission, tmp_path / "a3", resume_from).state == "succeeded"
    assert arrays(tmp_path / "a3.zip") == arrays(tmp_path / "undisturbed.zip")


def test_a_cancelled_run_keeps_what_it_computed(admission: Admission, tmp_path: Path) -> None:
    report = after(2, Answer.cancel, [])
    outcome = execute(admission, tmp_path / "out", target(tmp_path / "out"), report=report)
    assert outcome.state == "cancelled"
    assert outcome.error is None
    reader = ResultReader(tmp_path / "out.zip")
    reader.verify()
    time, _ = reader.history(["slider7.x"])
    assert not reader.complete
    assert 0 < len(time) < admission.samples


def test_a_run_that_cannot_go_on_says_why_and_keeps_what_it_computed(tmp_path: Path) -> None:
    # friction that turns round within 1e-12 m/s, at a tolerance near the rounding of doubles
    parameters = {"static_velocity": 1e-12, "dynamic_velocity": 2e-12, "friction": 1.0}
    scene = {"preset": "seven-bar-press", "parameters": parameters}
    outcome = run(admit(JOB | {"scene": scene, "tolerance": 1e-13}), tmp_path / "out")
    assert outcome.state == "failed"
    assert outcome.error is not None
    assert (outcome.error.error_class, outcome.error.code) == ("solver", "step-size-underflow")
    assert outcome.error.time is not None
    assert 0 < outcome.error.time < 1
    reader = ResultReader(tmp_path / "out.zip")
    reader.verify()
    time, _ = reader.history(["slider7.x"])
    assert len(time) > 0
    assert time[-1] <= outcome.error.time


def test_a_run_that_computes_too_long_fails_with_what_it_has(
    admission: Admission, tmp_path: Path
) -> None:
    outcome = execute(
        admission,
        tmp_path / "out",
        target(tmp_path / "out"),
        report=lambda _: Answer.go_on,
        longest=1e-6,
    )
    assert outcome.state == "failed"
    assert outcome.error is not None
    assert (outcome.error.error_class, outcome.error.code) == ("limit", "time-limit")
    reader = ResultReader(tmp_path / "out.zip")
    reader.verify()
    time, _ = reader.history(["slider7.x"])
    assert not reader.complete
    assert 0 < len(time) < admission.samples
    assert time[-1] <= outcome.time < 60.0


def test_results_are_never_written_over(admission: Admission, tmp_path: Path) -> None:
    run(admission, tmp_path / "out")
    with pytest.raises(StoreExists):
        run(admission, tmp_path / "out")
