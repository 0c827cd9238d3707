"""The jobs of a reproduction computed, each into a store of its own, and these stores read."""

import shutil
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Final, cast

from jointplay.paper import cases
from jointplay.paper.cases import Run
from jointplay.paper.variants import Variant
from jointplay.solver.kinds import Admission, Study, admit, parse
from jointplay.solver.runs.processes import Advance, Call, Processes
from jointplay.solver.runs.study.run import StudyRun
from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.storage.results import ResultReader
from jointplay.storage.studies import StudyReader
from jointplay.worker.execute import execute
from jointplay.worker.local.computing import Report
from jointplay.worker.local.folder import RUNNING
from jointplay.worker.study_block import create_store, run_block, seal_store

_SEALS_FROM: Final = 0.96
"""Share of the progress that is computing; the rest makes stores of studies durable."""


class RunFailed(Exception):
    """A job of the reproduction did not come to its end; the sentence says which and why."""


class Stores:
    """Readers of the stores that `compute` left in a folder; names as in `cases.name`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._run, self._study = cache(ResultReader), cache(StudyReader)

    def path(self, kind: str, which: object, variant: Variant | None = None) -> Path:
        """Return the file of a store."""
        return self._folder / cases.name(kind, which, variant)

    def run(self, kind: str, which: object, variant: Variant | None = None) -> ResultReader:
        """Open the results of a simulation, once."""
        return self._run(self.path(kind, which, variant))

    def study(self, kind: str, which: object, variant: Variant) -> StudyReader:
        """Open the results of a study, once."""
        return self._study(self.path(kind, which, variant))


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
    pool.make(
        seals,
        lambda done, *_: report(
            _SEALS_FROM + (1.0 - _SEALS_FROM) * done, "making the results durable"
        ),
    )
    shutil.rmtree(folder / RUNNING)


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
