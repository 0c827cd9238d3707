"""The work of a claimed block: a simulation, a block of a study, or the sealing of one."""

import logging
import shutil
from collections.abc import Callable
from typing import Protocol

from jointplay.solver.kinds import Admission, Study, parse
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.errors import CheckpointMismatch, CorruptStore, IncompleteStudy, NotAStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed.reading import Packed
from jointplay.storage.results.manifest import verify
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import discard_others, seal
from jointplay.worker.advance import noted_target
from jointplay.worker.execute import Outcome, Report, execute
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.leaving_room import leaving_room
from jointplay.worker.spent import publishing
from jointplay.worker.study_block import run_block

_log = logging.getLogger(__name__)


class Work(Protocol):
    """One claimed block's work."""

    recognised: bool
    """Whether a second attempt at the block finds that it is done, and need not repeat it."""

    def execute(self, report: Report, advanced: Callable[[], None]) -> Outcome:
        """Do it, from the restart point of the attempt before if there is one.

        `advanced` is for what has no slices.
        """
        ...


class SimulationWork:
    """A whole simulation, into a store of this attempt."""

    recognised = False

    def __init__(self, admission: Admission, claim: Claim, settings: Settings) -> None:
        self._admission = admission
        self._block = claim.block
        self._folder = settings.running_run(claim.job.id, claim.block.attempt).folder
        self._settings = settings

    def execute(self, report: Report, advanced: Callable[[], None]) -> Outcome:
        """Simulate, unless an attempt that was lost had come to its end."""
        target = self._sealed(self._block.attempt)
        if (adopted := self._adopted(target, advanced)) is not None:
            return adopted
        self._clear(target)
        target = noted_target(leaving_room(target, self._settings), advanced)
        try:
            return self._simulated(target, report, self._block.checkpoint)
        except CorruptStore as damage:
            _log.warning("block %s begins anew: %s", self._block.id, damage)
            shutil.rmtree(self._folder)
            return self._simulated(target, report, None)

    def _clear(self, target: StoredObject) -> None:
        """Remove what an attempt of this number left of which the catalogue knows no more.

        An older copy of it was put back, or a power cut undid the claim.
        """
        if target.exists():
            _log.warning("block %s: %s is of an attempt that was undone", self._block.id, target)
            target.object_store.remove(target.key)
        if self._folder.exists():
            shutil.rmtree(self._folder)

    def _simulated(self, target: StoredObject, report: Report, restart: str | None) -> Outcome:
        return execute(
            self._admission,
            self._folder,
            target,
            report=report,
            resume_from=restart,
            longest=self._settings.longest,
        )

    def _sealed(self, attempt: int) -> StoredObject:
        return self._settings.sealed_run(self._block.job, attempt)

    def _adopted(self, target: StoredObject, advanced: Callable[[], None]) -> Outcome | None:
        """Take over what an attempt sealed that was lost before it could say so.

        It may have had the number of this one, see `_clear`. Returns None if none sealed anything.
        """
        for attempt in range(self._block.attempt, 0, -1):
            lost = self._sealed(attempt)
            try:
                run = ResultReader(Packed(lost))
                run.verify(advanced)
            except (NotAStore, CorruptStore):
                continue
            if run.complete and run.attributes["solver_version"] == SOLVER_VERSION:
                if lost != target and not target.object_store.adopt(target.key, lost.key):
                    continue
                end = float(self._admission.job["duration"])
                return Outcome("succeeded", end, 1.0, statistics=run.attributes["summary"])
        return None


class StudyWork:
    """One block of a study, into the store that all its blocks fill."""

    recognised = True

    def __init__(self, study: Study, layout: StudyLayout, claim: Claim, settings: Settings) -> None:
        self._study, self._layout = study, layout
        self._block = claim.block
        self._settings = settings

    def execute(self, report: Report, advanced: Callable[[], None]) -> Outcome:
        """Compute the block's points, unless the study was sealed: see `_is_sealed`."""
        block = self._block
        if _is_sealed(self._settings.sealed_study(block.job), self._layout):
            return Outcome("succeeded", 0.0, 1.0)
        name = block.checkpoint
        folder = self._settings.running_study(block.job).folder
        if discard_others(folder, self._layout):
            _log.warning("%s held another job's documents; they are made anew", folder)
        return run_block(
            self._study,
            block.index,
            folder,
            report=report,
            attempt=block.attempt,
            resume_from=None if name is None else (name, block.progress_fraction),
            layout=self._layout,
            longest=self._settings.longest,
        )


class SealWork:
    """The end of a study: its store gets what all blocks left for it, and the manifest."""

    recognised = False  # with it the job ends, which must be durable

    def __init__(self, study: Study, layout: StudyLayout, job: str, settings: Settings) -> None:
        self._study, self._layout = study, layout
        self._job, self._settings = job, settings
        self._target = leaving_room(settings.sealed_study(job), settings)
        self._folder = settings.running_study(job).folder

    def execute(self, report: Report, advanced: Callable[[], None]) -> Outcome:
        """Seal. It takes a moment and is not interrupted: all that was asked for is computed.

        What a block left and is damaged by now is computed again.
        """
        if _is_sealed(self._target, self._layout, advanced):
            return Outcome("succeeded", 0.0, 1.0)
        if self._target.exists():
            _log.warning("%s is not what it was, and is sealed again", self._target)
            self._target.object_store.remove(self._target.key)
        try:
            with publishing():
                seal(self._folder, self._layout, self._target, advanced)
        except (CorruptStore, CheckpointMismatch, IncompleteStudy) as damage:
            _log.warning("blocks of %s are computed again: %s", self._folder, damage)
            discard_others(self._folder, self._layout)
            for index in range(len(self._study.blocks)):
                outcome = run_block(
                    self._study, index, self._folder, report=report, layout=self._layout
                )
                if outcome.state != "succeeded":
                    return outcome
            with publishing():
                seal(self._folder, self._layout, self._target, advanced)
        return Outcome("succeeded", 0.0, 1.0)


def _is_sealed(
    target: StoredObject, layout: StudyLayout, advanced: Callable[[], None] | None = None
) -> bool:
    """Whether there are results of this study, by this solver, of which the catalogue knows not.

    An older copy of it was put back, or whoever sealed them was lost. `advanced` : every byte is
    looked at, file by file.
    """
    try:
        packed = Packed(target)
        attributes = StudyReader(packed).attributes
        if advanced is not None:
            verify(packed, advanced)
    except (NotAStore, CorruptStore):
        return False
    return bool(attributes["complete"]) and attributes["layout"] == layout.digest


_last_study: tuple[str, Study, StudyLayout] | None = None


def work_of(claim: Claim, settings: Settings) -> Work:
    """Return what a claimed block asks for.

    The last study of this process is remembered: its blocks come one after the other.

    Raises
    ------
    InvalidInput
        The job's document is not one that this solver takes.
    """
    global _last_study
    job = claim.job
    if _last_study is None or _last_study[0] != job.id:
        admitted = parse(job.spec)
        if isinstance(admitted, Admission):
            return SimulationWork(admitted, claim, settings)
        _last_study = job.id, admitted, layout_of_study(admitted)
    _, study, layout = _last_study
    if claim.block.count == 0:
        return SealWork(study, layout, job.id, settings)
    return StudyWork(study, layout, claim, settings)
