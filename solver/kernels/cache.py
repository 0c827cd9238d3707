"""Where compiled code is kept.

The whole cache lives under a digest of all sources of this package and of `records`: compiled code
takes nothing from elsewhere, and a generated module is named by its tapes. Wiping it is always
safe. Installations of the same sources share it.
"""

import gc
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from jointplay import records
from jointplay.solver.version import source_digest

_SOURCES = (Path(__file__).parent, Path(records.__file__).parent)


@cache
def cache_folder() -> Path:
    """Return the folder of code compiled by these sources, made on first use.

    ``JOINTPLAY_CACHE`` chooses the folder's parent; the default is the user's cache folder, or a
    private temporary one where that cannot be written.
    """
    chosen = os.environ.get("JOINTPLAY_CACHE") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache"),
        "jointplay",
    )
    digest = "".join(source_digest(folder)[:8] for folder in _SOURCES)
    for parent in (Path(chosen), Path(tempfile.gettempdir()) / f"jointplay-{os.getuid()}"):
        folder = parent / f"kernels-{digest}"
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError:
            continue
        return folder
    raise OSError("no folder for compiled kernels can be written; set JOINTPLAY_CACHE to one")


def write_whole(path: Path, content: bytes) -> None:
    """Write a file that other processes find whole or not at all, also after a power cut."""
    with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as partial:
        try:
            partial.write(content)
            partial.flush()
            os.fsync(partial.fileno())
            os.replace(partial.name, path)
        except BaseException:
            os.unlink(partial.name)
            raise


@dataclass
class Spent:
    """Cost of compiling sources so far."""

    seconds: float = 0.0
    """Processor time of this process."""
    elsewhere: float = 0.0
    """Time for which it waited for processes that compiled for it."""


SPENT = Spent()


@contextmanager
def without_collection() -> Iterator[None]:
    """Compile without looking for garbage: nearly all objects live on, and it takes a sixth."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()
