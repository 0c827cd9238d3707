"""All blocks of a study on this machine's cores, each result through the study's store."""

import json
from collections.abc import Callable
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, cast

from jointplay.solver.runs.processes import Advance, Call, Interrupted, cores, processes
from jointplay.worker.local.interruption import interruption

if TYPE_CHECKING:
    from jointplay.solver.kinds import Study
    from jointplay.storage.places import StoredObject
    from jointplay.worker.execute import Outcome

Report = Callable[[float, str], None]
_DIED = "A process that computed a part of the study died; what others stored is kept."


def compute_study(
    study: "Study", folder: Path, target: "StoredObject", processes: int | None, report: Report
) -> "Outcome":
    """Compute a study into a store; what is computed does not depend on the processes.

    Parameters
    ----------
    study
        As admitted.
    folder
        Where the store is filled.
    target
        Where the sealed store goes.
    processes
        How many; by default one for each core.
    report
        Called several times a second with the fraction of the whole, and a few words.

    Returns
    -------
    Outcome
        The store is sealed if it is "succeeded", otherwise it keeps what was computed: "cancelled"
        by Ctrl-C, or "failed" because one of the processes was ended from outside.
    """
    from jointplay.records.job import JobError
    from jointplay.storage.studies.store import create, seal
    from jointplay.worker.execute import Outcome
    from jointplay.worker.study_block import layout_of

    done = 0.0

    def tell(fraction: float, note: str) -> None:
        nonlocal done
        done = fraction
        report(fraction, note)

    wanted = min(processes or cores(), len(study.blocks))
    report(0.0, "preparing the kernels")
    layout = layout_of(study)
    create(folder, layout)
    try:
        complete = (
            _here(study, folder, tell) if wanted == 1 else _spread(study, folder, wanted, tell)
        )
    except BrokenProcessPool:
        return Outcome("failed", 0.0, done, JobError("platform", "process-died", _DIED))
    if not complete:
        return Outcome("cancelled", 0.0, done)
    report(1.0, f"{study.points} of {study.points} points")
    seal(folder, layout, target)
    return Outcome("succeeded", 0.0, 1.0)


def _here(study: "Study", folder: Path, report: Report) -> bool:
    """Compute all blocks in this process, one after the other."""
    from jointplay.worker.execute import Progress
    from jointplay.worker.study_block import run_block

    with interruption() as asked_to_end:
        for index, (first, count) in enumerate(study.blocks):

            def go_on(done: Progress, first: int = first, count: int = count) -> str:
                ended = first + done.watermark
                fraction = (first + count * done.fraction) / study.points
                report(fraction, f"{ended} of {study.points} points")
                return "cancel" if asked_to_end() else "continue"

            if run_block(study, index, folder, report=go_on).state != "succeeded":
                return False
    return True


def _spread(study: "Study", folder: Path, count: int, report: Report) -> bool:
    """Compute the blocks in several processes, each taking the next one when it is free."""
    job = json.dumps(study.job)
    calls = [
        Call(_block, (job, str(folder), index), weight=points, parts=points)
        for index, (_, points) in enumerate(study.blocks)
    ]

    def show(fraction: float, points: int, _: str) -> None:
        if fraction > 0.0:
            report(fraction, f"{points} of {study.points} points")

    with interruption() as asked_to_end, processes(count, len(calls), asked_to_end) as pool:
        try:
            return pool.make(calls, show) == ["succeeded"] * len(calls)
        except Interrupted:
            return False


@lru_cache(maxsize=1)
def _study(job: str) -> "Study":
    """Parse an admitted study, once in each process."""
    from jointplay.solver.kinds import parse

    return cast("Study", parse(json.loads(job)))


def _block(job: str, folder: str, index: int, advance: Advance) -> str:
    """Compute one block and return how it ended."""
    from jointplay.worker.execute import Progress
    from jointplay.worker.study_block import run_block

    def go_on(done: Progress) -> str:
        return "continue" if advance(done.fraction, done.watermark) else "cancel"

    return run_block(_study(job), index, Path(folder), report=go_on).state
