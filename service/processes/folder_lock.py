"""One service a data folder: a lock that ends with the process, and names its holder."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from jointplay.service.processes.child import WrongSetting


@contextmanager
def holding(data: Path) -> Iterator[Callable[[str], object]]:
    """Hold a data folder while the block runs; WrongSetting if another service does.

    Yields what writes who holds it, for the message to the next one.  A folder that was made for
    it goes again if nothing was put into it.
    """
    from filelock import FileLock, Timeout  # asyncio, which commands without a service need not

    path = data / "serve.lock"
    is_new = not data.exists()
    data.mkdir(parents=True, exist_ok=True)
    lock = FileLock(path)
    try:
        lock.acquire(blocking=False)
    except Timeout as error:
        holder = path.read_text(errors="replace").strip()
        raise WrongSetting(
            f"{data} is in use by another jointplay serve ({holder});"
            " stop it, or give another folder with --data"
        ) from error
    try:
        path.write_text(f"process {os.getpid()}")
        yield path.write_text
    finally:
        lock.release()
        if is_new and {*data.iterdir()} <= {path}:
            path.unlink(missing_ok=True)
            data.rmdir()
