"""One service a data folder: a lock that ends with the process, and names its holder."""

import os
from pathlib import Path
from typing import Self

from jointplay.service.processes.child import WrongSetting


class FolderLock:
    """Holds a data folder while it is entered; WrongSetting if another service does.

    A folder that was made for it goes again if nothing was put into it.
    """

    def __init__(self, data: Path) -> None:
        from filelock import FileLock  # loads asyncio, which commands without a service need not

        self._data = data
        self._path = data / "serve.lock"
        self._lock = FileLock(self._path)
        self._is_new = False

    def __enter__(self) -> Self:
        from filelock import Timeout

        self._is_new = not self._data.exists()
        self._data.mkdir(parents=True, exist_ok=True)
        try:
            self._lock.acquire(blocking=False)
        except Timeout as error:
            holder = self._path.read_text(errors="replace").strip()
            raise WrongSetting(
                f"{self._data} is in use by another jointplay serve ({holder});"
                " stop it, or give another folder with --data"
            ) from error
        self.say(f"process {os.getpid()}")
        return self

    def say(self, holder: str) -> None:
        """Write who holds the folder, for the message to the next one."""
        self._path.write_text(holder)

    def __exit__(self, *_: object) -> None:
        self._lock.release()
        if self._is_new and {*self._data.iterdir()} <= {self._path}:
            self._path.unlink(missing_ok=True)
            self._data.rmdir()
