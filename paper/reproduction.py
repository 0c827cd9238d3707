"""The whole reproduction: compute each job into a store of its own, draw, write."""

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, cast

from jointplay.paper import cases, pictures, report
from jointplay.paper.cases import Run, Stores
from jointplay.paper.variants import Size
from jointplay.records.whole_file import write_whole
from jointplay.solver.kinds import Admission, Study, admit, parse
from jointplay.solver.runs.processes import Advance, Call, Processes, cores, processes
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.results.metadata import FILE
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, execute
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.local.attempts import next_attempt
from jointplay.worker.local.block_attempts import BlockAttempt, block_attempts
from jointplay.worker.local.computing import Report
from jointplay.worker.local.folder import RUNNING
from jointplay.worker.local.interruption import interruption
from jointplay.worker.local.restart_points import RestartPoints
from jointplay.worker.local.study import compute_block, open_store

RUNS = "runs"
PAGE = "report.html"
_DRAWING_FROM = 0.85
"""Share of the progress that is computing; the rest is drawing."""
_SEALS_FROM: Final = 0.96
"""Share of the progress that is computing; the rest makes stores of studies durable."""


class RunFailed(Exception):
    """A job of the reproduction did not come to its end; the sentence says which and why."""


def reproduce(folder: Path, size: Size, count: int | None, progress: Report) -> Path:
    """Compute everything into a folder, on `count` processes, and return the report's path.

    What an earlier call left of the same reproduction is not computed again: it goes on.

    Raises
    ------
    Interrupted
        By Ctrl-C, SIGTERM or SIGHUP.
    RunFailed
        A simulation failed.
    OSError
        The folder cannot be written.
    """
    chosen = cases.runs(size)
    stores = folder / RUNS
    with (
        interruption() as asked_to_end,
        processes(count or cores(), 64 * len(chosen), asked_to_end) as pool,
    ):
        _compute(
            chosen,
            cases.kernels(size),
            stores,
            pool,
            lambda done, note: progress(_DRAWING_FROM * done, note),
        )
        drawn = pictures.pictures(Stores(stores), size)
        images = pool.make(
            [picture.call for picture in drawn],
            lambda done, ended, note: progress(
                _DRAWING_FROM + (1.0 - _DRAWING_FROM) * done,
                f"drawing {ended} of {len(drawn)}: {note}",
            ),
        )
    page = folder / PAGE
    write_whole(page, report.page(stores, size, list(zip(drawn, images, strict=True))))
    return page


def _compute(
    chosen: Sequence[Run], kernels: Sequence[Run], folder: Path, pool: Processes, tell: Report
) -> None:
    """Compute runs into stores named for them in a folder, alike on any number of processes.

    `kernels` are jobs that need the same kernels: they go first, so that every kernel is compiled
    once only.  A point of a study may fail: its store says so.
    """
    tell(0.0, "preparing the kernels")
    pool.make([Call(_prepare, (run,)) for run in kernels])
    calls, seals = [], []
    for run in chosen:
        running = folder / RUNNING / run.name
        target = StoredObject(Folder(str(folder)), run.name)
        admitted = admit(run.job)
        if _is_there(target, admitted):
            continue
        if isinstance(admitted, Admission):
            running.mkdir(parents=True, exist_ok=True)
            calls.append(Call(_simulate, (run, running, target), run.weight, note=run.name))
            continue
        study = admitted
        run = replace(run, job=study.job)
        open_store(running, layout_of_study(study))
        attempts = block_attempts(running)
        seals.append(Call(_seal, (run, running, target)))
        for block, (_, count) in enumerate(study.blocks):
            weight = run.weight * count / study.points
            arguments = (run, block, running, attempts.get(block, BlockAttempt()))
            calls.append(Call(_block, arguments, weight, note=run.name))
    pool.make(
        calls,
        lambda done, ended, note: tell(_SEALS_FROM * done, f"{ended} of {len(calls)}: {note}"),
    )
    pool.make(
        seals,
        lambda done, *_: tell(
            _SEALS_FROM + (1.0 - _SEALS_FROM) * done, "making the results durable"
        ),
    )
    shutil.rmtree(folder / RUNNING, ignore_errors=True)


def _is_there(target: StoredObject, admitted: Admission | Study) -> bool:
    """Return whether the results are there already; what is not theirs is removed."""
    try:
        root = json.loads(Packed(target).read(FILE))["attributes"]
    except (NotAStore, CorruptStore, KeyError, ValueError):
        root = {}
    wanted = {"job": admitted.job, "solver_version": SOLVER_VERSION, "complete": True}
    if wanted.items() <= root.items():
        return True
    target.object_store.remove(target.key)
    return False


def _prepare(run: Run, advance: Advance) -> None:
    """Compile the kernels, or load them."""
    for _ in StudyRun(cast("Study", admit(run.job)), 0).slices():
        if not advance(0.0):
            return


def _simulate(run: Run, running: Path, target: StoredObject, advance: Advance) -> None:
    admission = cast("Admission", admit(run.job))
    restart_points = RestartPoints(lambda done: advance(done.fraction), Answer.leave)
    folder, restart = next_attempt(running)
    outcome = execute(admission, folder, target, report=restart_points, resume_from=restart)
    if outcome.error is not None:
        raise RunFailed(f"{run.name}: {outcome.error.detail}")


def _block(run: Run, block: int, running: Path, begin: BlockAttempt, advance: Advance) -> None:
    study = cast("Study", parse(run.job))
    compute_block(study, block, running, begin, lambda done: advance(done.fraction))


def _seal(run: Run, running: Path, target: StoredObject, advance: Advance) -> None:
    seal(running, layout_of_study(cast("Study", parse(run.job))), target)
