"""Files and ends that a worker hands in of the block that it holds: looked at, then taken."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from functools import partial
from typing import IO, Final

from jointplay.service.workers.uploads import Uploads
from jointplay.storage.attempt_files import LEAST, AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block, BlockState, Job
from jointplay.storage.errors import CorruptStore
from jointplay.storage.installation import require_reachable
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed.ranges import InFile, InParts
from jointplay.storage.settings import Settings
from jointplay.worker.handed_in import names, results
from jointplay.worker.handed_in.expected import expected_of
from jointplay.worker.removal import withdraw

_PIECE: Final = 2**20


class HandedIn:
    """Files of one attempt, of a job whose block a worker holds.

    Methods raise `worker.handed_in.errors.NotTheJobs` for what is not the job's, with which the
    block is taken back, `Fenced` for what another attempt or block has, and ValueError or
    FileNotFoundError for names that no file can have, ConnectionError while results cannot be
    stored.
    """

    def __init__(self, catalogue: Catalogue, settings: Settings, job: Job, held: Block) -> None:
        self._catalogue, self._settings = catalogue, settings
        self._job, self._held = job, held
        self._files = AttemptFiles(settings, held)

    @contextmanager
    def sending(
        self, uploads: Uploads, name: str, size: int, offset: int | None = None
    ) -> Iterator[None]:
        """Count a file while it arrives, which has so many bytes from an offset on."""
        expected = expected_of(self._job)
        self._require_own(name, names.writes)
        own = partial(names.writes, job=self._job, block=self._held, expected=expected)
        stored = partial(self._files.stored, own)
        largest = names.largest(name, expected)
        with ExitStack() as counted:
            with self._taking_back():
                if (offset or 0) + size > largest:
                    raise CorruptStore(f"{name} would have more than {largest} bytes")
                counts = max(size, LEAST)
                counted.enter_context(uploads.of_attempt(self._held, counts, expected.most, stored))
            yield

    def offered(
        self, uploads: Uploads, name: str, digest: str, size: int, seconds: float
    ) -> StoredObject | None:
        """Return the object that may be put for a file within some seconds.

        None where it is to be sent here: see `AttemptFiles.drop`.
        """
        with self.sending(uploads, name, size):
            dropped = self._files.drop(name, digest)
        if dropped is not None:
            most = expected_of(self._job).most
            with self._taking_back():
                uploads.offer(self._held, digest, size, most, seconds)
        return dropped

    def store(self, name: str, offset: int | None, content: IO[bytes]) -> None:
        """Store a file, or what it has from an offset on; of sealed results once they are right."""
        pieces = iter(lambda: content.read(_PIECE), b"")
        sealed = self._files.sealed(name)
        source = InFile(name, content)
        with self._taking_back():
            if sealed is not None:
                results.require_sealed(source, self._job)
                require_reachable(self._settings, self._catalogue)
                try:
                    sealed.put(pieces)
                except FileExistsError:  # the answer to an earlier try was lost
                    results.require_same(sealed, source)
            elif offset is not None:
                self._files.append(name, offset, pieces)
            else:
                if name == names.STUDY_DOCUMENTS:
                    results.require_documents_of(source, self._job, self._settings)
                self._files.put(name, pieces)
        self.require_still_held()

    def take(self, name: str, digest: str, size: int, md5: str) -> None:
        """Make a file of what was put into the bucket for it; see `AttemptFiles.take`."""
        self._require_own(name, names.writes)
        sealed = self._files.sealed(name)
        if sealed is None:
            self._files.take(name, digest, size, md5)
        else:
            with self._taking_back(), self._files.copied(name, digest, size) as copy:
                source = InParts(name, copy)
                results.require_sealed(source, self._job)
                if sealed.exists():
                    results.require_same(sealed, source)
                else:
                    sealed.object_store.adopt(sealed.key, copy.key)
        self.require_still_held()

    def remove(self, name: str) -> None:
        """Remove a file of the running job."""
        self._require_own(name, names.removes)
        self._files.remove(name)

    def require_end(self, outcome: BlockState, steps: int | None) -> None:
        """Look whether what is stored is what the end of the block speaks of."""
        require_reachable(self._settings, self._catalogue)
        with self._taking_back():
            results.require_end(self._settings, self._job, self._held, outcome, steps)

    def require_still_held(self) -> None:
        """Raise `Fenced` if the block was lost while a file was stored, which is then removed."""
        try:
            self._catalogue.held(self._held.id, self._held.attempt)
        except Fenced:
            withdraw(self._catalogue, self._settings, self._held)
            raise

    def _require_own(self, name: str, may: Callable[..., bool]) -> None:
        if self._files.sealed(name) is None:
            self._files.checked(name)
        if not may(name, self._job, self._held, expected_of(self._job)):
            raise names.NotOwn(self._held.id, self._held.attempt, name)

    def _taking_back(self) -> AbstractContextManager[None]:
        return results.taking_back(self._catalogue, self._settings, self._job, self._held)
