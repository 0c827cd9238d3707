"""Where compiled code is kept.

Numba keys its cache on a file's own text, so a change in a file that it calls would go unseen:
the whole cache lives under a digest of all sources of this package: compiled code calls nothing
outside of it, and a generated module is named by its tapes. Wiping it is always safe. Installations
of the same sources share it.
"""

import gc
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Self

import numba
from numba.core.caching import UserProvidedCacheLocator

from jointplay.solver.kernels.compiler import leave_out_slow_passes
from jointplay.solver.kernels.inner_functions import link_inner_functions
from jointplay.solver.version import source_digest

_PACKAGE = Path(__file__).parent


@cache
def cache_folder() -> Path:
    """Return the folder of code compiled by these sources, made on first use.

    From then on Numba keeps its code there, and compiles as `compiler` says.
    ``JOINTPLAY_CACHE`` chooses the folder's parent; the default is the user's cache folder, or a
    private temporary one where that cannot be written.
    """
    chosen = os.environ.get("JOINTPLAY_CACHE") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache"),
        "jointplay",
    )
    digest = source_digest(_PACKAGE)
    for parent in (Path(chosen), Path(tempfile.gettempdir()) / f"jointplay-{os.getuid()}"):
        folder = parent / f"kernels-{digest}"
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError:
            continue
        leave_out_slow_passes()
        link_inner_functions()
        settings: Any = numba.config  # which Numba fills when it is imported
        settings.CACHE_DIR = str(folder)
        settings.CACHE_LOCATOR_CLASSES = f"{__name__}.OwnSources,UserProvidedCacheLocator"
        return folder
    raise OSError("no folder for compiled kernels can be written; set JOINTPLAY_CACHE to one")


class OwnSources(UserProvidedCacheLocator):
    """Where Numba keeps code of this package: under the file's path in it, wherever it lies."""

    @classmethod
    def get_suitable_cache_subpath(cls, py_file: str) -> str:
        """Return the folder of a file of this package, relative to the package."""
        return str(Path(py_file).parent.relative_to(_PACKAGE))

    @classmethod
    def from_function(cls, py_func: Callable[..., Any], py_file: str) -> Self | None:
        """Return the locator of a function; None for functions of other packages."""
        if not Path(py_file).is_relative_to(_PACKAGE):
            return None
        found: Self | None = super().from_function(py_func, py_file)  # type: ignore[no-untyped-call]
        return found


def write_whole(path: Path, content: bytes) -> None:
    """Write a file that other processes find whole or not at all."""
    with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as partial:
        partial.write(content)
    os.replace(partial.name, path)


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
