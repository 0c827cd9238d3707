"""A job whose results are in a folder, as the same object that a client has."""

import shutil
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.client.errors import ClientError, NotFound
from jointplay.client.job import Job
from jointplay.storage.errors import ResultsError
from jointplay.worker.local.folder import JOB_FILE, OUTCOME_FILE, RUNNING, STORE, holding
from jointplay.worker.local.outcome import outcome_of

if TYPE_CHECKING:
    from jointplay.local.folder_results import FolderResults
    from jointplay.storage.results.reader import ResultReader
    from jointplay.storage.studies.reader import StudyReader

_TABLES = ("peaks.csv", "points.csv", "accuracy.json", "calibration.json")
_FILES = (JOB_FILE, STORE, OUTCOME_FILE, *_TABLES)
_FOLDERS = (RUNNING, "figures")
"""That `run`, and the commands ``jointplay run`` and ``jointplay plot``, write into."""


class FolderJob(Job):
    """A `Job` in a folder, which has ended."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        super().__init__(self._look())

    def retry(self) -> Job:
        """Refuse: a run in a folder is no job of a service."""
        sentence = "A run in a folder goes on with jointplay.resume(folder), or anew."
        raise ClientError(sentence)

    def delete(self) -> None:
        """Remove what a run leaves in its folder, and the folder if nothing else is in it.

        A store that was given by itself is removed.

        Raises
        ------
        BlockingIOError
            Another process is computing the job.
        """
        if self._folder.is_file():
            self._folder.unlink()
            return
        with holding(self._folder):
            for name in _FILES:
                (self._folder / name).unlink(missing_ok=True)
            for name in _FOLDERS:
                shutil.rmtree(self._folder / name, ignore_errors=True)
        if not any(self._folder.iterdir()):
            self._folder.rmdir()

    def _open_results(self) -> "FolderResults":
        from jointplay.local.folder_results import FolderResults

        return FolderResults(store_in(self._folder), results_in(self._folder))

    def _look(self) -> dict[str, Any]:
        """Return what a service would say of the job."""
        source = results_in(self._folder)
        attributes = source.attributes
        job = attributes["job"]
        return {
            "id": str(self._folder),
            "kind": job["kind"],
            "label": job.get("label") or None,
            "batch": None,
            "activity": None,
            "attempt": 1,
            "expires": None,
            "links": dict.fromkeys(_results_of(source), str(store_in(self._folder))),
            "job": job,
            "solver_version": attributes.get("solver_version"),
            **self._outcome(float(job.get("duration") or 0.0), complete=source.complete),
        }

    def _outcome(self, end: float, *, complete: bool) -> dict[str, Any]:
        """Return how the job ended; of a store alone only that it is whole, or not, is known."""
        try:
            found = outcome_of(self._folder)
        except ValueError as error:
            sentence = "is not what was written; remove it, the results can be read without it"
            raise ResultsError(f"{self._folder / OUTCOME_FILE} {sentence}.") from error
        except (FileNotFoundError, NotADirectoryError):
            written = datetime.fromtimestamp(self._folder.stat().st_mtime, UTC).isoformat()
            found = {
                "state": "succeeded" if complete else "cancelled",
                "error": None,
                "started": None,
                "finished": written,
                "progress": {"time": end * complete, "fraction": float(complete)},
            }
        return {**found, "created": found["started"] or found["finished"]}

    def _ask_to_end(self) -> dict[str, Any]:
        return self._look()

    def _follow(self, deadline: float | None) -> Iterator[None]:
        yield from ()


def load(folder: Path | str) -> Job:
    """Return the job whose results `run`, or the command ``jointplay run``, left in a folder.

    Raises
    ------
    jointplay.client.NotFound
        There are none.
    """
    return FolderJob(Path(folder))


def store_in(folder: Path) -> Path:
    """Return the store in a run's folder: packed, or still in pieces if the run was cut short.

    The packed store itself may be given too; `NotFound` if there is none.
    """
    from jointplay.worker.local.growing import growing_store

    if folder.is_file():
        with folder.open("rb") as file:
            if file.read(2) != b"PK":  # as every store begins, also one that was cut off
                wanted = f"give a run's folder, its {STORE}, or a job's id"
                raise NotFound(f"{folder} is no store of results: {wanted}.")
        return folder
    store = folder / STORE if (folder / STORE).exists() else growing_store(folder)
    if store is None:
        raise NotFound(f"{folder} holds no results: give a folder that a run made, or a job's id.")
    return store


def results_in(folder: Path) -> "ResultReader | StudyReader":
    """Return the results in a run's folder: of a simulation, or of a study; or `NotFound`."""
    from jointplay.local.exact_windows import trajectory_of
    from jointplay.solver.nonlinear.reasons import undecided_reasons
    from jointplay.storage.errors import NotAStore
    from jointplay.storage.results.reader import ResultReader
    from jointplay.storage.studies.reader import StudyReader
    from jointplay.worker.local.growing import growing_results

    store = store_in(folder)
    kinds = (partial(StudyReader, store), partial(ResultReader, store))
    for read in kinds if store.is_file() else (partial(growing_results, folder),):
        try:
            found = read()
        except NotAStore as error:
            why = error
        else:
            if isinstance(found, ResultReader):
                found.trajectory = trajectory_of(found)
            else:
                found.grounds = undecided_reasons
            return found
    raise NotFound(f"{store} holds no results that this version reads: {why}.") from why


def _results_of(source: "ResultReader | StudyReader") -> list[str]:
    """Return the names of the results that a store holds, as a service has them."""
    from jointplay.storage.studies.reader import StudyReader

    if not isinstance(source, StudyReader):
        return ["history", "peaks", "poincare", "impacts", "statistics", "certificate"]
    if "runs" in source.attributes:
        return ["points", "accuracy"]
    if "states" in source.attributes:
        return ["points", "attractors"]
    if source.kind in ("calibration", "sensitivity"):
        return ["points", source.kind]
    own = ["branch"] if "labels" in source.attributes else []
    return ["points", *own, "poincare" if source.record else "sweep"]
