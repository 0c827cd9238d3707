"""One job, computed here and now into a folder."""

import json
import shutil
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.worker.local.folder import JOB_FILE, OUTCOME_FILE, RUNNING, STORE
from jointplay.worker.local.interruption import interruption

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study
    from jointplay.worker.execute import Outcome

Report = Callable[[float, str], None]


def compute(
    admission: "Admission | Study", folder: Path, processes: int | None, report: Report
) -> "Outcome":
    """Compute a checked job; Ctrl-C ends it between two slices of a quarter second.

    Parameters
    ----------
    admission
        As `solver.kinds.admit` returned it.
    folder
        Where job, store and outcome go; it is there, and empty.
    processes
        Of a study; by default one for each core.
    report
        Called several times a second with the fraction of the whole, and a few words.

    Returns
    -------
    Outcome
        Whatever it is, what was computed is kept.
    """
    from jointplay.solver.kinds import Study

    begun = datetime.now(UTC)
    (folder / JOB_FILE).write_text(json.dumps(admission.job, indent=2) + "\n")
    running, target = folder / RUNNING, StoredObject(Folder(str(folder)), STORE)
    if isinstance(admission, Study):
        from jointplay.worker.local.study import compute_study

        outcome = compute_study(admission, running, target, processes, report)
    else:
        outcome = _simulation(admission, running, target, report)
    if target.exists():
        shutil.rmtree(running)
    _write_outcome(folder, begun, outcome)
    return outcome


def _simulation(
    admission: "Admission", running: Path, target: StoredObject, report: Report
) -> "Outcome":
    report(0.0, "preparing the kernel")
    from jointplay.worker.execute import Progress, execute

    with interruption() as asked_to_end:

        def go_on(done: Progress) -> str:
            report(done.fraction, f"t = {done.time:.4g} s")
            return "cancel" if asked_to_end() else "continue"

        return execute(admission, running, target, report=go_on)


def _write_outcome(folder: Path, begun: datetime, outcome: "Outcome") -> None:
    """Write beside the results how the run ended."""
    document = {
        "state": outcome.state,
        "error": outcome.error and outcome.error.document(),
        "started": begun.isoformat(),
        "finished": datetime.now(UTC).isoformat(),
        "progress": {"time": outcome.time, "fraction": outcome.fraction},
    }
    (folder / OUTCOME_FILE).write_text(json.dumps(document, indent=2) + "\n")
