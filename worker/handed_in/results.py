"""Results as workers hand them in: found to be the job's, or refused."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from jointplay.records.log_lines import about
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, BlockState, Job
from jointplay.storage.errors import CorruptStore, NotAStore, ResultsError
from jointplay.storage.identity import require_results_of
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed.ranges import Ranges
from jointplay.storage.packed.reading import Packed
from jointplay.storage.results.examination import ODD, opened
from jointplay.storage.results.examined_run import examined_run
from jointplay.storage.results.layout import MANIFEST, ResultLayout
from jointplay.storage.results.metadata import Document
from jointplay.storage.settings import Settings
from jointplay.storage.studies.examined_part import require_part
from jointplay.storage.studies.examined_study import examined_study, require_documents
from jointplay.storage.studies.layout import StudyLayout
from jointplay.worker.handed_in import names
from jointplay.worker.handed_in.errors import NotTheJobs
from jointplay.worker.handed_in.expected import expected_of

_LONGEST: Final = 500
"""Characters of a reason, which may quote what was handed in."""
_log = logging.getLogger(__name__)


@contextmanager
def taking_back(catalogue: Catalogue, settings: Settings, job: Job, block: Block) -> Iterator[None]:
    """Take the block back, and remove what its attempt left, if results are found to be no good.

    Raises
    ------
    NotTheJobs
        They are.
    Fenced
        They are, and the attempt does not hold the block any more.
    """
    try:
        yield
    except CorruptStore as error:
        reason = "".join(one if one.isprintable() else "?" for one in str(error)[:_LONGEST])
        catalogue.refuse(block.id, block.attempt, settings.max_attempts, reason)
        with about(job=job.id, block=block.id, attempt=block.attempt):
            _log.warning("%s handed in results that are refused: %s", block.worker, reason)
            _remove(settings, job, block)
        raise NotTheJobs(reason) from error


def _remove(settings: Settings, job: Job, block: Block) -> None:
    """Remove what is the attempt's own: another one may have begun."""
    files, expected = AttemptFiles(settings, block), expected_of(job)
    try:
        for name in [*files.own_sealed()]:
            sealed = files.sealed(name)
            if sealed is not None and names.writes(name, job, block, expected):
                sealed.object_store.remove(sealed.key)
        for name in [*files.running.names()]:
            if names.removes(name, job, block, expected):
                files.running.remove(name)
    except OSError as error:
        _log.warning("what was refused stays for now: %s", error)


@contextmanager
def _doubting(name: str) -> Iterator[None]:
    """Raise `CorruptStore` for whatever may go wrong where something made up is read."""
    try:
        yield
    except CorruptStore:
        raise
    except (*ODD, NotAStore, ResultsError) as error:
        raise CorruptStore(f"{name} cannot be read: {error}") from error


def require_sealed(source: Ranges, job: Job) -> None:
    """Read a sealed store whole, once.

    Raises
    ------
    CorruptStore
        It is not whole, another job's, or not what this job gives.
    """
    expected = expected_of(job)
    layout = expected.layout
    if layout is None:
        raise CorruptStore("this service cannot read the job, so that its own workers compute it")
    with _doubting(str(source)):
        if isinstance(layout, ResultLayout):
            root = examined_run(source, layout, same=expected.same)
        else:
            root = examined_study(source, layout, same=expected.same)
        _require_identity(root, job, str(source))


def require_same(stored: StoredObject, source: Ranges) -> None:
    """Raise `CorruptStore` if two whole stores differ: their manifests do then."""
    with _doubting(str(stored)):
        one, other = Packed(stored), Packed(source)
        if one.entries != other.entries or one.read(MANIFEST) != other.read(MANIFEST):
            raise CorruptStore(f"{stored} was sealed before, with other bytes")


def require_documents_of(source: Ranges, job: Job, settings: Settings) -> None:
    """Raise `CorruptStore` if documents of a study that runs are not those of this job.

    All blocks make the same: of two digests of the layout that which this program gives stays.
    """
    expected = expected_of(job)
    layout = expected.layout
    with _doubting(names.STUDY_DOCUMENTS):
        content, root = opened(source)
        if expected.same and isinstance(layout, StudyLayout):
            require_documents(content, layout)
        _require_identity(root, job, names.STUDY_DOCUMENTS)
        digest = root["layout"]
    try:
        stored = settings.running_study(job.id).attributes["layout"]
    except (*ODD, ResultsError):
        return  # there are none, or they are damaged
    if digest != stored and not (isinstance(layout, StudyLayout) and digest == layout.digest):
        raise CorruptStore(f"{names.STUDY_DOCUMENTS} is stored already, with another layout")


def require_end(
    settings: Settings, job: Job, block: Block, outcome: BlockState, steps: int | None
) -> None:
    """Raise `CorruptStore` if what is stored is not what an end of a block speaks of.

    What has a sealed name was read whole before it got that; here its root is looked at.

    Parameters
    ----------
    outcome, steps
        As the worker tells them.
    """
    done = outcome is BlockState.done
    with _doubting(f"what was stored of block {block.index}"):
        if names.is_run(job):
            told = block.progress_steps if steps is None else steps
            _require_of_run(settings.sealed_run(job.id, block.attempt), told, done=done)
        elif done:
            _require_of_study(settings, job, block)


def _require_of_run(sealed: StoredObject, told: int | None, *, done: bool) -> None:
    if not sealed.exists():
        if done:
            raise CorruptStore("nothing was sealed")
        return
    _, root = opened(sealed)
    if root["complete"] is not done:
        raise CorruptStore(f"{sealed} holds {'half' if done else 'all'} of the run")
    stored = root["summary"].get("steps")
    if None not in (stored, told) and stored != told:
        raise CorruptStore(f"{sealed} holds a run of {stored} steps, not of {told}")


def _require_of_study(settings: Settings, job: Job, block: Block) -> None:
    if block.count == 0:
        if not settings.sealed_study(job.id).exists():
            raise CorruptStore("nothing was sealed")
        return
    layout, same, _ = expected_of(job)
    if isinstance(layout, StudyLayout):
        require_part(settings.running_study(job.id), layout, block.index, same=same)


def _require_identity(root: Document, job: Job, name: str) -> None:
    """Raise `CorruptStore` if attributes name another job, or another version of the solver."""
    require_results_of(job, root, name)
    if root.get("solver_version") != job.solver_version:
        raise CorruptStore(f"{name} is of another version of the solver")
