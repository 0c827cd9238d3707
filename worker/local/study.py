"""All blocks of a study on this machine's cores, each result through the study's store."""

import multiprocessing
import signal
import sys
from collections.abc import Callable, Iterator, MutableSequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from jointplay.worker.local.cores import cores
from jointplay.worker.local.interruption import interruption

if TYPE_CHECKING:
    from jointplay.solver.kinds import Study

_POLL = 0.1  # s between two looks at the progress of other processes


class ProcessDied(Exception):
    """A process that computed a part of the study died; what others stored is kept."""


Report = Callable[[float, str], None]


def compute(study: "Study", folder: Path, processes: int | None, report: Report) -> bool:
    """Compute a study into a store; what is computed does not depend on the processes.

    Parameters
    ----------
    study
        As admitted.
    folder
        For the store.
    processes
        How many; by default one for each core.
    report
        Called several times a second with the fraction of the whole, and a few words.

    Returns
    -------
    bool
        Whether the study came to its end; not if it was interrupted by Ctrl-C.  The store is
        sealed then, otherwise it keeps what was computed.

    Raises
    ------
    ProcessDied
        One of the processes was ended from outside.
    """
    from jointplay.worker.study_block import create_store, seal_store

    wanted = min(processes or cores(), len(study.blocks))
    report(0.0, "preparing the kernels")
    create_store(study, folder)
    run = _here if wanted == 1 else _spread
    if not run(study, folder, wanted, report):
        return False
    report(1.0, f"{study.points} of {study.points} points")
    seal_store(study, folder)
    return True


def _here(study: "Study", folder: Path, processes: int, report: Report) -> bool:
    """Compute all blocks in this process, one after the other."""
    from jointplay.worker.study_block import StudyProgress, run_block

    with interruption() as asked_to_end:
        for index, (first, count) in enumerate(study.blocks):

            def go_on(done: StudyProgress, first: int = first, count: int = count) -> str:
                ended = first + done.watermark
                fraction = (first + count * done.fraction) / study.points
                report(fraction, f"{ended} of {study.points} points")
                return "cancel" if asked_to_end() else "continue"

            if run_block(study, index, folder, report=go_on).state != "succeeded":
                return False
    return True


def _spread(study: "Study", folder: Path, processes: int, report: Report) -> bool:
    """Compute the blocks in several processes, each taking the next one when it is free."""
    context = multiprocessing.get_context("spawn")  # threads of libraries do not survive a fork
    fractions = context.Array("d", len(study.blocks), lock=False)
    ended = context.Array("l", len(study.blocks), lock=False)
    leave = context.Value("b", 0, lock=False)
    shared = (study.job, str(folder), fractions, ended, leave)
    counts = [count for _, count in study.blocks]
    with (
        interruption() as asked_to_end,
        ProcessPoolExecutor(processes, context, _begin, shared) as pool,
    ):
        with _without_main():
            running: set[Future[str]] = {pool.submit(_block, i) for i in range(len(study.blocks))}
        states: list[str] = []
        try:
            while running:
                done, running = wait(running, _POLL, FIRST_COMPLETED)
                states += [future.result() for future in done if not future.cancelled()]
                if asked_to_end() and not leave.value:
                    leave.value = 1
                    for future in running:
                        future.cancel()
                weighted = sum(f * c for f, c in zip(fractions, counts, strict=True))
                if any(fractions):
                    report(weighted / study.points, f"{sum(ended)} of {study.points} points")
        except BrokenProcessPool:
            raise ProcessDied from None
        finally:
            leave.value = 1  # after an error too, nobody goes on for nothing
            pool.shutdown(wait=False, cancel_futures=True)
    return states == ["succeeded"] * len(study.blocks)


@contextmanager
def _without_main() -> Iterator[None]:
    """Start processes that do not begin by running the caller's script again.

    They would look for functions in it; ours are in this module.
    """
    main = sys.modules["__main__"]
    hidden = {name: main.__dict__.pop(name, None) for name in ("__file__", "__spec__")}
    main.__spec__ = None
    try:
        yield
    finally:
        main.__dict__.update({name: one for name, one in hidden.items() if one is not None})


class _Process:
    """What one of the processes works on: set once when it begins."""

    study: "Study"
    folder: Path
    fractions: MutableSequence[float]
    ended: MutableSequence[int]
    leave: Any


def _begin(
    job: dict[str, Any],
    folder: str,
    fractions: MutableSequence[float],
    ended: MutableSequence[int],
    leave: Any,
) -> None:
    """Prepare a process of the pool; Ctrl-C is for the one that reports."""
    from jointplay.solver.kinds import parse

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _Process.study, _Process.folder = cast("Study", parse(job)), Path(folder)
    _Process.fractions, _Process.ended, _Process.leave = fractions, ended, leave


def _block(index: int) -> str:
    """Compute one block and return how it ended."""
    from jointplay.worker.study_block import StudyProgress, run_block

    def go_on(done: StudyProgress) -> str:
        _Process.fractions[index], _Process.ended[index] = done.fraction, done.watermark
        return "cancel" if _Process.leave.value else "continue"

    outcome = run_block(_Process.study, index, _Process.folder, report=go_on)
    if outcome.state == "succeeded":
        _Process.fractions[index] = 1.0
        _Process.ended[index] = _Process.study.blocks[index][1]
    return outcome.state
