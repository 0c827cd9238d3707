"""All blocks of a study on this machine's cores, each result through the study's store."""

import json
import shutil
import time
from collections.abc import Callable, Sequence
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.solver.runs.processes import Advance, Call, Interrupted, cores, processes
from jointplay.worker.local.block_attempts import BlockAttempt, block_attempts
from jointplay.worker.local.study_of import study_of

if TYPE_CHECKING:
    from jointplay.solver.kinds import Study
    from jointplay.storage.object_stores import StoredObject
    from jointplay.storage.studies.layout import StudyLayout
    from jointplay.worker.execute import Outcome, Progress
    from jointplay.worker.local.devices import Lanes

Report = Callable[[float, str], None]
STORE = "study"
"""Folder of the growing store, which all attempts fill together."""
_BEGINNING = 2.0
"""Seconds that other processes take to begin."""
_LOOK = 0.2
"""Seconds of computing that tell how long the rest will take."""
_DIED = "A process that computed a part of the study died; what others stored is kept."


def compute_study(
    study: "Study",
    running: Path,
    target: "StoredObject",
    processes: int | None,
    report: Report,
    asked_to_end: Callable[[], bool],
    device: "Lanes | None",
) -> "Outcome":
    """Compute a study into a store; what is computed does not depend on the processes.

    Blocks that an earlier call ended are not computed again; those that it began go on.

    Parameters
    ----------
    running, target
        Folder of the growing store, with what an earlier call left; where the sealed one goes.
    processes
        How many at most; by default one for each core, or one beside a device. What takes no longer
        than others take to begin is computed in this one.
    report, asked_to_end
        Called several times a second, the first with the fraction of the whole, and a few words.
    device
        What opens a device in each process, which then computes many blocks together.

    Returns
    -------
    Outcome
        The store is sealed if it is "succeeded", otherwise it keeps what was computed: "cancelled"
        by a signal, or "failed" because a block did, or a process was ended from outside.
    """
    from jointplay.records.job import JobError
    from jointplay.storage.studies.store import seal
    from jointplay.worker.execute import Outcome
    from jointplay.worker.layouts import layout_of_study

    done = 0.0

    def tell(fraction: float, note: str) -> None:
        nonlocal done
        if fraction >= done:  # processes first find out what is computed already
            done = fraction
            report(fraction, note)

    report(0.0, "preparing the kernels")
    layout, folder = layout_of_study(study), running / STORE
    open_store(folder, layout)
    try:
        ends = _computed(study, folder, processes, device, tell, asked_to_end)
    except BrokenProcessPool:
        return Outcome("failed", 0.0, done, JobError("platform", "process-died", _DIED))
    for outcome in ends:
        if outcome.state == "failed":
            return Outcome("failed", 0.0, done, outcome.error)
    if not ends or any(outcome.state != "succeeded" for outcome in ends):
        return Outcome("cancelled", 0.0, done)
    report(1.0, f"{study.points} of {study.points} points")
    seal(folder, layout, target)
    return Outcome("succeeded", 0.0, 1.0)


def _computed(
    study: "Study",
    folder: Path,
    processes: int | None,
    device: "Lanes | None",
    report: Report,
    asked_to_end: Callable[[], bool],
) -> "list[Outcome]":
    """Compute all blocks, and return how they ended; none if the end was asked for."""
    wanted = min(processes or (cores() if device is None else 1), len(study.blocks))
    if device is None:
        rest = _Rest()

        def leaves(fraction: float) -> bool:
            return asked_to_end() or (wanted > 1 and rest.is_long(fraction))

        ends = _here(study, folder, report, leaves)
        if wanted == 1 or ends[-1].state != "left" or asked_to_end():
            return ends
    elif wanted == 1:
        return [_on_device(study, folder, device, report, asked_to_end)]
    calls = _calls(study, folder, wanted, device)
    return _spread(study, calls, wanted, report, asked_to_end)


class _Rest:
    """Rest of a study, by what was done since this was first asked."""

    def __init__(self) -> None:
        self._first: tuple[float, float] | None = None

    def is_long(self, fraction: float) -> bool:
        """Whether it takes longer than other processes take to begin; `fraction` is done."""
        now = time.monotonic()
        begun, before = self._first = self._first or (now, fraction)
        seconds, done = now - begun, fraction - before
        return seconds > _LOOK and seconds * (1.0 - fraction) > _BEGINNING * done


def _attempts(study: "Study", folder: Path) -> dict[int, BlockAttempt]:
    """Return the next attempt at each block."""
    begun = block_attempts(folder)
    return {index: begun.get(index, BlockAttempt()) for index in range(len(study.blocks))}


def open_store(folder: Path, layout: "StudyLayout") -> None:
    """Make the store, or find it; one that another version of the program began is of no use."""
    from jointplay.storage.errors import StoreExists
    from jointplay.storage.studies.store import create

    try:
        create(folder, layout)
    except StoreExists:
        shutil.rmtree(folder)
        create(folder, layout)


def _here(
    study: "Study",
    folder: Path,
    report: Report,
    leaves: Callable[[float], bool],
) -> "list[Outcome]":
    """Compute all blocks in this process, one after the other, until one does not succeed.

    leaves : asked several times a second, with the fraction of the whole.
    """
    from jointplay.worker.execute import Progress

    attempts = _attempts(study, folder)
    ends: list[Outcome] = []
    for index, (first, count) in enumerate(study.blocks):

        def go_on(done: Progress, first: int = first, count: int = count) -> bool:
            ended = first + done.watermark
            fraction = (first + count * done.fraction) / study.points
            report(fraction, f"{ended} of {study.points} points")
            return not leaves(fraction)

        ends.append(compute_block(study, index, folder, attempts[index], go_on))
        if ends[-1].state != "succeeded":
            break
    return ends


def _on_device(
    study: "Study",
    folder: Path,
    device: "Lanes",
    report: Report,
    asked_to_end: Callable[[], bool],
) -> "Outcome":
    """Compute all blocks in this process, by a device."""

    def go_on(done: "Progress") -> bool:
        report(done.fraction, f"{done.watermark} of {study.points} points")
        return not asked_to_end()

    from jointplay.worker.local.pooled import compute_pooled

    return compute_pooled(study, folder, _attempts(study, folder), device, go_on)


def _calls(study: "Study", folder: Path, count: int, device: "Lanes | None") -> list[Call]:
    """Return calls that compute a block each, or, for a device, a part for each process."""
    attempts = _attempts(study, folder)
    if device is not None:
        from jointplay.worker.local.pooled import calls_of_parts

        return calls_of_parts(study, folder, attempts, count, device)
    job = json.dumps(study.job)
    return [
        Call(_block, (job, str(folder), index, attempts[index]), points, points)
        for index, (_, points) in enumerate(study.blocks)
    ]


def _spread(
    study: "Study",
    calls: Sequence[Call],
    count: int,
    report: Report,
    asked_to_end: Callable[[], bool],
) -> "list[Outcome]":
    """Make the calls in several processes, each taking the next one when it is free."""

    def show(fraction: float, points: int, _: str) -> None:
        if fraction > 0.0:
            report(fraction, f"{points} of {study.points} points")

    with processes(count, len(calls), asked_to_end) as pool:
        try:
            return pool.make(calls, show, in_order=bool(study.refine))  # the coarse grid first
        except Interrupted:
            return []


def _block(job: str, folder: str, index: int, begin: BlockAttempt, advance: Advance) -> "Outcome":
    """Compute one block in a process of the pool and return how it ended."""
    return compute_block(
        study_of(job),
        index,
        Path(folder),
        begin,
        lambda done: advance(done.fraction, done.watermark),
    )


def compute_block(
    study: "Study",
    index: int,
    folder: Path,
    begin: BlockAttempt,
    go_on: "Callable[[Progress], bool]",
) -> "Outcome":
    """Compute one block, with restart points, and return how it ended; "left" can go on."""
    from jointplay.worker.execute import Answer
    from jointplay.worker.local.restart_points import RestartPoints
    from jointplay.worker.study_block import run_block

    restart = None if begin.resume_from is None else (begin.resume_from, 0.0)
    restart_points = RestartPoints(go_on, Answer.leave)
    return run_block(
        study, index, folder, report=restart_points, attempt=begin.number, resume_from=restart
    )
