"""The growing store of a local run that has not ended, for those who read it."""

from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.worker.local.folder import RUNNING
from jointplay.worker.local.study import STORE as STUDY

if TYPE_CHECKING:
    from jointplay.storage.results.reader import ResultReader
    from jointplay.storage.studies.reader import StudyReader


def growing_store(folder: Path) -> Path | None:
    """Return the folder of the growing store in a run's folder; None if there is none."""
    from jointplay.worker.local.attempts import newest_attempt

    study = folder / RUNNING / STUDY
    if study.is_dir():
        return study
    found = newest_attempt(folder / RUNNING)
    return None if found is None else found.folder


def growing_results(folder: Path) -> "ResultReader | StudyReader":
    """Read what a run has computed up to its last restart point, or `NotAStore`."""
    from jointplay.storage.errors import NotAStore
    from jointplay.storage.results.reader import ResultReader
    from jointplay.storage.studies.reader import StudyReader
    from jointplay.worker.local.attempts import newest_attempt

    study = folder / RUNNING / STUDY
    if study.is_dir():
        return StudyReader(study)
    found = newest_attempt(folder / RUNNING)
    if found is None:
        raise NotAStore(f"{folder} holds no results")
    return ResultReader(found.folder, found.samples)
