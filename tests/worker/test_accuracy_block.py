"""The block of an accuracy-study into a real store, interrupted and resumed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr

from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision
from jointplay.storage.packed.zarr_store import FilesStore
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, Progress
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.study_block import run_block
from tests.stores import packed, target

JOB = {
    "kind": "accuracy-study",
    "scene": {"preset": "seven-bar-press"},
    "duration": 0.015,
    "methods": ["tsitouras", "rk4"],
    "tolerances": [1e-4, 1e-8],
}
"""To a few milliseconds after the first impact, at which the longest steps of rk4 fail."""


@pytest.fixture(scope="module")
def study() -> Study:
    found = admit(JOB)
    assert isinstance(found, Study)
    return found


@pytest.fixture(scope="module")
def undisturbed(study: Study, tmp_path_factory: pytest.TempPathFactory) -> StudyReader:
    folder = tmp_path_factory.mktemp("undisturbed") / "store"
    assert run_block(study, 0, folder).state == "succeeded"
    seal(folder, layout_of_study(study), target(folder))
    return StudyReader(packed(folder))


def repeatable(reader: StudyReader) -> dict[str, Any]:
    """All that does not depend on the clock."""
    found = WorkPrecision.of(reader).document()
    return found | {"points": [one | {"seconds": 0.0} for one in found["points"]]}


def test_what_is_stored_has_units_and_says_what_failed(undisturbed: StudyReader) -> None:
    undisturbed.verify()
    assert undisturbed.complete
    assert undisturbed.points == 11
    assert {one.code for one in undisturbed.failures.values()} == {"fixed-step-too-long"}
    numbers = zarr.open_group(FilesStore(undisturbed.files), mode="r")["statistics"]
    assert isinstance(numbers, zarr.Group)
    units = {name: numbers[name].attrs["units"] for name in ("error", "window", "seconds")}
    assert units == {"error": "1", "window": "s", "seconds": "s"}
    found = WorkPrecision.of(undisturbed).document()
    assert len(found["points"]) == 9
    assert found["advice"].startswith("The default, tsitouras at 1e-06")


def test_a_block_that_is_left_and_resumed_keeps_what_was_measured(
    study: Study, undisturbed: StudyReader, tmp_path: Path
) -> None:
    names: list[str] = []

    def leave_after(points: int) -> Any:
        def report(progress: Progress) -> Answer:
            if progress.watermark < points:
                return Answer.go_on
            names.append(progress.keep()[0])
            return Answer.leave

        return report

    first = run_block(study, 0, tmp_path, report=leave_after(5))
    assert first.state == "left"
    seconds = StudyReader(tmp_path).statistics["seconds"]
    assert np.isfinite(seconds).tolist() == [True] * 5 + [False] * 6
    resume_from = (names[0], first.fraction)
    assert run_block(study, 0, tmp_path, attempt=2, resume_from=resume_from).state == "succeeded"
    seal(tmp_path, layout_of_study(study), target(tmp_path))
    resumed = StudyReader(packed(tmp_path))
    np.testing.assert_array_equal(resumed.statistics["seconds"][:5], seconds[:5])
    assert repeatable(resumed) == repeatable(undisturbed)


def test_a_cancelled_study_keeps_what_was_measured_and_recommends_nothing(
    study: Study, tmp_path: Path
) -> None:
    outcome = run_block(
        study,
        0,
        tmp_path,
        report=lambda done: Answer.cancel if done.watermark == 4 else Answer.go_on,
    )
    assert outcome.state == "cancelled"
    found = WorkPrecision.of(StudyReader(tmp_path)).document()
    assert (found["complete"], len(found["points"]), found["advice"]) == (False, 2, None)
