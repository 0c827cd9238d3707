"""Modules of compiled functions: made of tapes once, kept in the cache, loaded into the process."""

import hashlib
import json
import tempfile
import time
from collections.abc import Sequence
from dataclasses import astuple, replace
from pathlib import Path

from filelock import FileLock

from jointplay.solver.kernels.cache import SPENT, cache_folder, without_collection, write_whole
from jointplay.solver.kernels.emit.functions import Function
from jointplay.solver.kernels.emit.machine_code import compiled, load_code
from jointplay.solver.kernels.emit.tapes import Source, module_text
from jointplay.solver.kernels.target import Target, own_target
from jointplay.solver.kernels.watched import compile_elsewhere, is_watched


class Module:
    """Compiled functions, by their names as attributes."""

    def __init__(self, sources: Sequence[Source], prefix: str) -> None:
        """Name functions that are loaded, with a prefix to their names."""
        self.sources, self.prefix = tuple(sources), prefix
        vars(self).update({one.name: one.function(prefix) for one in sources})

    def __getattr__(self, name: str) -> Function:
        raise AttributeError(f"the module has no function '{name}'")


def load(sources: Sequence[Source], lanes: int = 0, target: Target | None = None) -> Module:
    """Return the functions of tapes: compiled, or found in the cache or in this process to be.

    Raises what `watched` does, where somebody watches.

    Parameters
    ----------
    lanes
        Advanced at once; 0: as many as the target has.
    target
        That they are for; by default that of this process.
    """
    target = target or own_target()
    target = replace(target, lanes=lanes or target.lanes)
    about = repr(([astuple(one) for one in sources], target.mark))
    prefix = f"jointplay.{hashlib.sha256(about.encode()).hexdigest()[:24]}"
    load_code(prefix, lambda: _code(cache_folder() / f"{prefix}.o", sources, target))
    return Module(sources, prefix)


def _code(path: Path, sources: Sequence[Source], target: Target) -> bytes:
    """Return a module's code; only one process compiles it, others find that it is done."""
    if is_watched() and not path.exists():
        _compile_elsewhere(path, sources, target)
    with FileLock(path.with_suffix(".lock")):
        if not path.exists():
            begun = time.process_time()
            with without_collection():
                text = module_text(sources, path.stem, target.lanes)
                write_whole(path, compiled(text, target))
            SPENT.seconds += time.process_time() - begun
    return path.read_bytes()


def _compile_elsewhere(path: Path, sources: Sequence[Source], target: Target) -> None:
    """Have another process compile a module into the cache."""
    begun = time.monotonic()
    with tempfile.NamedTemporaryFile("w", dir=path.parent, suffix=".json") as file:
        json.dump((str(path), [astuple(one) for one in sources], target.lanes), file)
        file.flush()
        try:
            compile_elsewhere(Path(file.name))
        finally:
            SPENT.elsewhere += time.monotonic() - begun


def compile_file(file: Path) -> None:
    """Compile the module that a file of `_compile_elsewhere` describes."""
    path, given, lanes = json.loads(file.read_text())
    sources = [Source(name, tuple(lines), over, rows) for name, lines, over, rows in given]
    _code(Path(path), sources, replace(own_target(), lanes=lanes))
