"""Computes the jobs of a reproduction, each into a store of its own."""

import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, cast

from jointplay.paper.cases import Run
from jointplay.solver.kinds import Admission, Study, admit, parse
from jointplay.solver.runs.processes import Advance, Call, Processes
from jointplay.solver.runs.study.run import StudyRun
from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.worker.execute import execute
from jointplay.worker.local.computing import Report
from jointplay.worker.local.folder import RUNNING
from jointplay.worker.study_block import create_store, run_block, seal_store

_SEALS_FROM: Final = 0.96
"""Share of the progress that is computing; the rest makes stores of studies durable."""


class RunFailed(Exception):
    """A job of the reproduction did not come to its end; the sentence says which and why."""


def compute(
    chosen: Sequence[Run], kernels: Sequence[Run], folder: Path, pool: Processes, report: Report
) -> None:
    """Compute runs into stores named for them in a folder.

    What is computed does not depend on the processes.  `kernels` are jobs that need the same
    kernels: they go first, so that every kernel is compiled once only.

    Raises
    ------
    Interrupted
        By Ctrl-C; what is in the folder is of no use then.
    RunFailed
        A simulation failed.  A point of a study may fail: its store says so.
    OSError
        The stores cannot be written.
    """
    report(0.0, "preparing the kernels")
    pool.make([Call(_prepare, (run,)) for run in kernels])
    calls, seals = [], []
    for run in chosen:
        running = folder / RUNNING / run.name
        target = StoredObject(Folder(str(folder)), run.name)
        if run.job["kind"] == "simulate":
            calls.append(Call(_simulate, (run, running, target), run.weight, note=run.name))
            continue
        study = cast("Study", admit(run.job))
        run = replace(run, job=study.job)
        create_store(study, running)
        seals.append(Call(_seal, (run, running, target)))
        for block, (_, count) in enumerate(study.blocks):
            weight = run.weight * count / study.points
            calls.append(Call(_block, (run, block, running), weight, note=run.name))
    pool.make(
        calls,
        lambda done, ended, note: report(_SEALS_FROM * done, f"{ended} of {len(calls)}: {note}"),
    )
    pool.make(seals, lambda done, *_: report(_share(done), "making the results durable"))
    shutil.rmtree(folder / RUNNING)


def _share(fraction: float) -> float:
    return _SEALS_FROM + (1.0 - _SEALS_FROM) * fraction


def _prepare(run: Run, advance: Advance) -> None:
    """Compile the kernels, or load them."""
    for _ in StudyRun(cast("Study", admit(run.job)), 0).slices():
        if not advance(0.0):
            return


def _simulate(run: Run, running: Path, target: StoredObject, advance: Advance) -> None:
    admission = cast("Admission", admit(run.job))
    outcome = execute(
        admission,
        running,
        target,
        report=lambda done: "continue" if advance(done.fraction) else "cancel",
    )
    if outcome.error is not None:
        raise RunFailed(f"{run.name}: {outcome.error.detail}")


def _block(run: Run, block: int, running: Path, advance: Advance) -> None:
    run_block(
        cast("Study", parse(run.job)),
        block,
        running,
        report=lambda done: "continue" if advance(done.fraction) else "cancel",
    )


def _seal(run: Run, running: Path, target: StoredObject, advance: Advance) -> None:
    seal_store(cast("Study", parse(run.job)), running, target)
