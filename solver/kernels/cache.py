"""Where compiled code is kept, and how a generated module is loaded so that Numba finds it there.

Numba keys its cache on a file's own text, so a change in a file that it calls would go unseen:
the whole cache lives under a digest of all sources of this package: compiled code calls nothing
outside of it, and a generated module is named by its text. Wiping it is always safe. Installations
of the same sources share it.
"""

import gc
import hashlib
import importlib.util
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, Self

import numba
from filelock import FileLock
from numba.core.caching import UserProvidedCacheLocator

from jointplay.solver.kernels.compiler import leave_out_slow_passes
from jointplay.solver.kernels.inner_functions import link_inner_functions
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.watched import compile_if_watched
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


def load(source: str) -> ModuleType:
    """Import generated source under the name of its digest; compiled once, then from the cache.

    Raises what `watched` does, where somebody watches.
    """
    name = f"jointplay_kernel_{hashlib.sha256(source.encode()).hexdigest()[:24]}"
    if name in sys.modules:
        return sys.modules[name]
    path = cache_folder() / f"{name}.py"
    if not path.exists():
        write_whole(path, source.encode())
    if not is_compiled(path):
        begun = time.monotonic()
        try:
            compile_if_watched(path)
        finally:
            SPENT.elsewhere += time.monotonic() - begun
    return load_file(path)


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


def is_compiled(path: Path) -> bool:
    """Return whether all functions of a generated file are compiled for what this process is."""
    return _mark(path).exists()


def load_file(path: Path) -> ModuleType:
    """Import a generated file; what is not in the cache is compiled here.

    Only one process compiles a file; others wait for it, and find that it is done.
    """
    name = path.stem
    specification = importlib.util.spec_from_file_location(name, path)
    if specification is None or specification.loader is None:
        raise ImportError(f"cannot load {path}")
    module = importlib.util.module_from_spec(specification)
    with nullcontext() if is_compiled(path) else FileLock(path.with_suffix(".lock")):
        begun = time.process_time()
        sys.modules[name] = module  # before it runs, or Numba's cache does not load
        try:
            with without_collection():
                specification.loader.exec_module(module)
        except BaseException:
            del sys.modules[name]
            raise
        if not is_compiled(path):
            seconds = time.process_time() - begun
            SPENT.seconds += seconds
            _mark(path).write_text(f"{seconds:.3f} s of processor\n")
    return module


def _mark(path: Path) -> Path:
    return path.with_suffix(f".{own_target().mark}.compiled")


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
