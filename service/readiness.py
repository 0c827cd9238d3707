"""Whether a service can store and read, found out by doing it."""

import asyncio
import errno
import os
import socket
import tempfile
import time
from pathlib import Path
from typing import Final

from jointplay.service.vital import VitalThreads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import require_own_files
from jointplay.storage.object_stores.fitness import require_fit
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.settings import RUNNING, Settings

_PERIOD: Final = 1.0
"""Seconds for which what was found holds: whoever asks, and anyone may, has no more written."""
_OBJECT_STORE_PERIOD: Final = 30.0  # s; six requests to another server
_TRIAL: Final = b"trial"
_AT_ONCE: Final = 0.0  # s that this process leads: the next one that proves it may write, too


class Readiness:
    """Writes and reads, at most once a second, for all who ask meanwhile."""

    def __init__(self, catalogue: Catalogue, settings: Settings, vital: VitalThreads) -> None:
        self._catalogue, self._settings, self._vital = catalogue, settings, vital
        self._name = f"{socket.gethostname()}:{os.getpid()}"
        self._proof: asyncio.Future[None] | None = None
        self._proved = 0.0
        self._object_store_proved: float | None = None

    async def proved(self) -> None:
        """Return, or raise, what `prove` does now, or did less than a second ago."""
        proof = self._proof
        if proof is None or (proof.done() and time.monotonic() > self._proved + _PERIOD):
            proof = self._proof = asyncio.ensure_future(self._vital.run(self.prove))
            proof.add_done_callback(self._note)
        await asyncio.shield(proof)  # others wait for it, too

    def _note(self, proof: asyncio.Future[None]) -> None:
        self._proved = time.monotonic()
        if not proof.cancelled():
            proof.exception()  # nobody may be left who waits for it

    def prove(self) -> None:
        """Store something in the catalogue, the data folder and the object store.

        Raises
        ------
        jointplay.storage.catalogue.errors.Unavailable, RuntimeError
            The catalogue cannot be written, or has another schema.
        OSError
            The data folder, or the object store, cannot be written.
        OtherFiles
            They are those of another catalogue, or a disk is not mounted.
        """
        self._catalogue.ping()
        self._catalogue.take_lead("readiness", self._name, _AT_ONCE)
        data = self._settings.data
        if not data.is_dir():
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(data))
        (data / RUNNING).mkdir(exist_ok=True)
        self._write(data / RUNNING)
        store = self._settings.object_store
        if isinstance(store, Folder) and Path(store.root).is_dir():  # made for the first results
            self._write(Path(store.root))
        self._try_object_store()

    def _write(self, folder: Path) -> None:
        # without a name: in containers, APIs that share the folder have one process id
        with tempfile.TemporaryFile(dir=folder) as trial:
            trial.write(_TRIAL)
            trial.seek(0)
            if trial.read() != _TRIAL:
                raise OSError(errno.EIO, os.strerror(errno.EIO), str(folder))

    def _try_object_store(self) -> None:
        if (
            self._object_store_proved is None
            or time.monotonic() > self._object_store_proved + _OBJECT_STORE_PERIOD
        ):
            require_own_files(self._settings, self._catalogue)
            if not isinstance(self._settings.object_store, Folder):
                require_fit(self._settings.object_store, large=False)
            self._object_store_proved = time.monotonic()
