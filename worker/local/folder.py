"""The files of a local run's folder, and how the run ended."""

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jointplay.worker.execute import Outcome

JOB_FILE = "job.json"
STORE = "results.zarr.zip"
"""The sealed store, in one file."""
RUNNING = "running"
"""Folder of a store that is not sealed yet, or never was."""
OUTCOME_FILE = "outcome.json"


def write_outcome(folder: Path, begun: datetime, outcome: "Outcome") -> None:
    """Write beside the results how the run ended."""
    error = outcome.error
    document = {
        "state": outcome.state,
        "error": None if error is None else error.document(),
        "started": begun.isoformat(),
        "finished": datetime.now(UTC).isoformat(),
        "progress": {"time": outcome.time, "fraction": outcome.fraction},
    }
    (folder / OUTCOME_FILE).write_text(json.dumps(document, indent=2) + "\n")
