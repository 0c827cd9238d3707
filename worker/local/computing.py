"""One job, computed here and now into a folder."""

import json
import shutil
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.worker.local.folder import JOB_FILE, RUNNING, STORE, write_outcome
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
        outcome = _study(admission, running, target, processes, report)
    else:
        outcome = _simulation(admission, running, target, report)
    if target.exists():
        shutil.rmtree(running)
    write_outcome(folder, begun, outcome)
    return outcome


def _simulation(
    admission: "Admission", running: Path, target: StoredObject, report: Report
) -> "Outcome":
    report(0.0, "preparing the kernel")
    from jointplay.worker.execute import Progress, RestartPoint, execute

    with interruption() as asked_to_end:

        def go_on(done: Progress[RestartPoint]) -> str:
            report(done.fraction, f"t = {done.time:.4g} s")
            return "cancel" if asked_to_end() else "continue"

        return execute(admission, running, target, report=go_on)


def _study(
    study: "Study", running: Path, target: StoredObject, processes: int | None, report: Report
) -> "Outcome":
    from jointplay.records.job import JobError
    from jointplay.worker.execute import Outcome
    from jointplay.worker.local.study import ProcessDied, compute

    done = 0.0

    def tell(fraction: float, note: str) -> None:
        nonlocal done
        done = fraction
        report(fraction, note)

    try:
        complete = compute(study, running, target, processes, tell)
    except ProcessDied as died:
        sentence = died.__doc__ or ""
        return Outcome("failed", 0.0, done, JobError("platform", "process-died", sentence))
    return Outcome("succeeded" if complete else "cancelled", 0.0, done)
