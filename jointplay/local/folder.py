"""Reads the folder of a local run: its results, and the job's record."""

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.client.errors import NotFound
from jointplay.worker.local.folder import OUTCOME_FILE, RUNNING, STORE

if TYPE_CHECKING:
    from jointplay.storage.results import ResultReader
    from jointplay.storage.studies import StudyReader


def store_in(folder: Path) -> Path:
    """Return the store in a run's folder: packed, or still in pieces if the run was cut short.

    The packed store itself may be given too.

    Raises
    ------
    NotFound
        There is none.
    """
    if folder.is_file():
        return folder
    for store in (folder / STORE, folder / RUNNING):
        if store.exists():
            return store
    sentence = f"{folder} holds no results: give a folder that a run made, or a job's id."
    raise NotFound(sentence, status=404, problem="no-results")


def results_in(folder: Path) -> "ResultReader | StudyReader":
    """Return the results in a run's folder: of a simulation, or of a study.

    Raises
    ------
    NotFound
        There are none.
    """
    from jointplay.storage.results import NotAStore, ResultReader
    from jointplay.storage.studies import StudyReader

    store = store_in(folder)
    try:
        return StudyReader(store)
    except NotAStore:
        pass
    try:
        return ResultReader(store)
    except NotAStore as error:
        sentence = f"{store} holds no results that this version reads: {error}."
        raise NotFound(sentence, status=404, problem="no-results") from error


def job_document(folder: Path) -> dict[str, Any]:
    """Return what a service would say of the job whose results are in a folder."""
    source = results_in(folder)
    attributes = source.attributes
    job = attributes["job"]
    return {
        "id": str(folder),
        "kind": job["kind"],
        "label": job.get("label") or None,
        "batch": None,
        "activity": None,
        "attempt": 1,
        "expires": None,
        "links": dict.fromkeys(_results_of(source), str(store_in(folder))),
        "job": job,
        "solver_version": attributes.get("solver_version"),
        **_outcome_in(folder, job, complete=source.complete),
    }


def _results_of(source: "ResultReader | StudyReader") -> list[str]:
    """Return the names of the results that a store holds, as a service has them."""
    from jointplay.storage.studies import StudyReader

    if not isinstance(source, StudyReader):
        return ["history", "peaks", "poincare", "impacts", "statistics", "certificate"]
    if "runs" in source.attributes:
        return ["accuracy"]
    return ["poincare"] if source.record else ["sweep"]


def _outcome_in(folder: Path, job: dict[str, Any], *, complete: bool) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads((folder / OUTCOME_FILE).read_bytes())
    except (
        FileNotFoundError,
        NotADirectoryError,
    ):  # a store alone: only that it is whole, or not, is known
        written = datetime.fromtimestamp(folder.stat().st_mtime, UTC).isoformat()
        end = float(job.get("duration") or 0.0)
        found = {
            "state": "succeeded" if complete else "cancelled",
            "error": None,
            "started": None,
            "finished": written,
            "progress": {"time": end * complete, "fraction": float(complete)},
        }
    return {**found, "created": found["started"] or found["finished"]}
