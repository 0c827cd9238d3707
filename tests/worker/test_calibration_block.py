"""The block of a calibration into a real store, interrupted and resumed."""

from pathlib import Path
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.calibration.plan import CalibrationStudy
from jointplay.solver.calibration.run import CalibrationRun
from jointplay.solver.kinds import Study, admit
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, Progress
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from tests.solver.calibration.calibrations import bounce, computed
from tests.stores import packed, target

QUICK = bounce(search={"population": 4, "generations": 8}, spread={"generations": 4})


@pytest.fixture(scope="module")
def study() -> CalibrationStudy:
    found = admit(QUICK)
    assert isinstance(found, CalibrationStudy)
    return found


def sealed(study: Study, folder: Path) -> StudyReader:
    seal(folder, layout_of_study(study), target(folder))
    return StudyReader(packed(folder))


def test_one_that_is_left_and_resumed_finds_what_the_local_command_finds(
    study: CalibrationStudy, tmp_path: Path
) -> None:
    fractions: list[float] = []
    names: list[str] = []

    def report(progress: Progress) -> Answer:
        fractions.append(progress.fraction)
        if progress.fraction < 0.5:
            return Answer.go_on
        names.append(progress.keep()[0])
        return Answer.leave

    first = run_block(study, 0, tmp_path, report=report)
    assert first.state == "left"
    assert StudyReader(tmp_path).documents == {}
    assert fractions == sorted(fractions)
    again: list[float] = []
    second = run_block(
        study,
        0,
        tmp_path,
        attempt=2,
        resume_from=(names[0], first.fraction),
        report=lambda progress: again.append(progress.fraction) or Answer.go_on,
    )
    assert second.state == "succeeded"
    assert len(again) < len(fractions) + 10  # what was known is not computed again
    reader = sealed(study, tmp_path)
    reader.verify()
    outcome = computed(study.calibration)
    assert reader.documents == {0: outcome.document()}
    numbers = {name: float(column[0]) for name, column in reader.statistics.items()}
    steps = numbers.pop("steps")
    assert numbers == {
        "cost": outcome.cost,
        "best_stiffness": outcome.best[0],
        "best_restitution": outcome.best[1],
    }
    undisturbed = run_block(study, 0, tmp_path / "undisturbed")
    assert dict(undisturbed.statistics or {}) == {"steps": steps}


def test_one_that_is_left_before_any_cost_is_known_begins_anew(
    study: CalibrationStudy, tmp_path: Path
) -> None:
    run = CalibrationRun(study, 0)
    next(run.slices())
    (*_, last) = CalibrationRun(study, 0, run.checkpoint()).slices()
    assert [end.document for end in last.ended] == [computed(study.calibration).document()]


def test_one_of_which_every_run_fails_says_what_to_try(tmp_path: Path) -> None:
    impacts = {"channel": "bearing.normal_force", "to": 0.3, "value": 1000.0}
    search = {"generations": 1, "population": 2, "most_steps": 100}
    found: Any = admit(bounce(cases=[{"targets": [impacts]}], search=search))
    ended = run_block(found, 0, tmp_path)
    assert ended.state == "failed"
    assert ended.error is not None
    assert ended.error.code == "nothing-fits"
    assert "Narrow the bounds" in ended.error.detail
    assert StudyReader(tmp_path).documents == {}


def test_a_target_that_drivers_prescribe_is_refused_where_the_block_begins(tmp_path: Path) -> None:
    document = {
        "kind": "calibration",
        "scene": {"preset": "slider-crank"},
        "parameters": {"stiffness": {"minimum": 1e8, "maximum": 1e9}},
        "cases": [{"targets": [{"channel": "crank.vx", "to": 0.001, "value": 1.0}]}],
    }
    found: Any = admit(document)
    with pytest.raises(InvalidInput, match="follows from the drivers"):
        run_block(found, 0, tmp_path)
