"""One service a data folder: a lock that ends with the process, and says who holds it."""

import fcntl
import os
from pathlib import Path
from typing import Self

from jointplay.service.processes.child import WrongSetting


class FolderLock:
    """Holds a data folder while it is entered; WrongSetting if somebody else does.

    A folder that was made for it goes again if nothing was put into it.
    """

    def __init__(self, data: Path) -> None:
        self._data = data
        self._path = data / "serve.lock"
        self._file = -1
        self._is_new = False

    def __enter__(self) -> Self:
        self._is_new = not self._data.exists()
        self._data.mkdir(parents=True, exist_ok=True)
        self._file = os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600)
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            holder = os.read(self._file, 200).decode(errors="replace").strip()
            os.close(self._file)
            raise WrongSetting(
                f"{self._data} is in use by another jointplay serve ({holder});"
                " stop it, or give another folder with --data"
            ) from error
        self.say(f"process {os.getpid()}")
        return self

    def say(self, who: str) -> None:
        """Write who holds the folder, for whoever finds it locked."""
        os.ftruncate(self._file, 0)
        os.pwrite(self._file, who.encode(), 0)

    def __exit__(self, *_: object) -> None:
        if self._is_new and list(self._data.iterdir()) == [self._path]:
            self._path.unlink()
            self._data.rmdir()
        os.close(self._file)
