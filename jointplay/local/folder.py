"""The folder of a run, and the results in it."""

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.client.errors import NotFound

if TYPE_CHECKING:
    from storage.results import ResultReader
    from storage.studies import StudyReader
    from worker.execute import Outcome

JOB_FILE = "job.json"
STORE = "results.zarr"
OUTCOME_FILE = "outcome.json"


def store_in(folder: Path) -> Path:
    """Return the store in a run's folder; the store itself may be given too.

    Raises
    ------
    NotFound
        There is none.
    """
    for store in (folder / STORE, folder):
        if (store / "zarr.json").is_file():
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
    from storage.results import NotAStore, ResultReader
    from storage.studies import StudyReader

    store = store_in(folder)
    try:
        return StudyReader(store)
    except NotAStore:
        return ResultReader(store)


def write_outcome(folder: Path, begun: datetime, outcome: "Outcome") -> None:
    """Write beside the results how the run ended."""
    error = outcome.error
    document = {
        "state": outcome.state,
        "error": None if error is None else {"class": error.error_class, "detail": error.detail},
        "started": begun.isoformat(),
        "finished": datetime.now(UTC).isoformat(),
        "progress": {"time": outcome.time, "fraction": outcome.fraction},
    }
    (folder / OUTCOME_FILE).write_text(json.dumps(document, indent=2) + "\n")


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
        "links": {},
        "job": job,
        "solver_version": attributes.get("solver_version"),
        **_outcome_in(folder, job, complete=source.complete),
    }


def _outcome_in(folder: Path, job: dict[str, Any], *, complete: bool) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads((folder / OUTCOME_FILE).read_bytes())
    except FileNotFoundError:  # a store alone: only that it is whole, or not, is known
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
