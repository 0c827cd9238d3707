"""One job, computed here and now into a folder, or to its end from where it was cut short."""

import json
import shutil
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final

from jointplay.records.job import JobError
from jointplay.storage import durable
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.worker.local.folder import OUTCOME_FILE, STORE, holding, write_job
from jointplay.worker.local.interruption import interruption
from jointplay.worker.transient_faults import is_full

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study
    from jointplay.worker.execute import Outcome
    from jointplay.worker.local.devices import Lanes

Report = Callable[[float, str], None]
NO_ROOM: Final = "no-room"
"""Code of the error of a run that found its disk full."""


def compute(
    admission: "Admission | Study",
    folder: Path,
    processes: int | None,
    report: Report,
    device: "Lanes | None" = None,
) -> "Outcome":
    """Compute a checked job; signals that end a process end it between two slices.

    What an earlier call left of the same job is not computed again: it goes on from its last
    restart point, bit for bit.

    Parameters
    ----------
    admission
        As `solver.kinds.admit` returned it.
    folder
        Where job, store and outcome go; it is there, and empty, or has such a rest.
    processes
        Of a study, at most; by default one for each core, or one beside a device.
    report
        Called several times a second with the fraction of the whole, and a few words.
    device
        What opens a device, which then computes the points of a study.

    Returns
    -------
    Outcome
        Whatever it is, what was computed is kept.  "cancelled" by a signal, or "failed" with
        `NO_ROOM` where the disk is full: both can go on.

    Raises
    ------
    BlockingIOError
        Another process computes into the folder.
    """
    begun = datetime.now(UTC)
    target = StoredObject(Folder(str(folder)), STORE)
    reached = _Reached(report)
    with interruption() as asked_to_end, holding(folder) as running:
        write_job(folder, admission.job)
        _clear(folder)
        from jointplay.solver.kinds import Study  # from here on, loading takes seconds
        from jointplay.worker.local.study import compute_study

        try:
            if isinstance(admission, Study):
                outcome = compute_study(
                    admission, running, target, processes, reached.report, asked_to_end, device
                )
            else:
                outcome = _simulation(admission, running, target, reached, asked_to_end)
        except OSError as fault:
            if not is_full(fault):
                raise
            outcome = reached.without_room(folder)
        _write_outcome(folder, begun, outcome)
    if target.exists() and outcome.state != "cancelled":
        shutil.rmtree(running)
    return outcome


class _Reached:
    """Progress of a run, for the outcome of one that cannot tell it."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self.time = self.fraction = 0.0

    def report(self, fraction: float, note: str) -> None:
        """Note the fraction and pass it on."""
        self.fraction = fraction
        self._report(fraction, note)

    def without_room(self, folder: Path) -> "Outcome":
        from jointplay.worker.execute import Outcome

        sentence = (
            f"The disk of {folder} is full. What was computed up to the last restart point is"
            " kept: make room, and go on from there."
        )
        return Outcome("failed", self.time, self.fraction, JobError("platform", NO_ROOM, sentence))


def _simulation(
    admission: "Admission",
    running: Path,
    target: StoredObject,
    reached: _Reached,
    asked_to_end: Callable[[], bool],
) -> "Outcome":
    reached.report(0.0, "preparing the kernel")
    from jointplay.worker.execute import Answer, Progress, execute
    from jointplay.worker.local.attempts import next_attempt
    from jointplay.worker.local.restart_points import RestartPoints

    def go_on(done: Progress) -> bool:
        reached.time = done.time
        reached.report(done.fraction, f"t = {done.time:.4g} s")
        return not asked_to_end()

    folder, restart = next_attempt(running)
    restart_points = RestartPoints(go_on, Answer.cancel)
    return execute(admission, folder, target, report=restart_points, resume_from=restart)


def _clear(folder: Path) -> None:
    """Remove what an earlier end left beside `RUNNING`, which has all that was computed."""
    for name in (OUTCOME_FILE, STORE):
        (folder / name).unlink(missing_ok=True)
    for path in folder.glob(f"*{durable.PARTIAL}"):
        path.unlink(missing_ok=True)


def _write_outcome(folder: Path, begun: datetime, outcome: "Outcome") -> None:
    """Write beside the results how the run ended; a full disk may have no room for it."""
    document = {
        "state": outcome.state,
        "error": outcome.error and outcome.error.document(),
        "started": begun.isoformat(),
        "finished": datetime.now(UTC).isoformat(),
        "progress": {"time": outcome.time, "fraction": outcome.fraction},
    }
    try:
        durable.write(folder / OUTCOME_FILE, [(json.dumps(document, indent=2) + "\n").encode()])
    except OSError as fault:
        if not is_full(fault):
            raise
