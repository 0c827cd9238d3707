"""Machine code of the integration loop: compiled once by another process, loaded from the cache.

It is the same for every scene, whose own equations take seconds: on a machine that has never
computed, a second process compiles it while the first compiles the scene's own kernel. So no
process that computes needs Numba, which takes a second to import and to get ready.
"""

import subprocess
import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

from jointplay.solver.kernels.cache import cache_folder
from jointplay.solver.kernels.emit.machine_code import address_of_symbol, is_loaded, load_code
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.watched import CompilationTooLong, attend

FOR_RUNS, FOR_WINDOWS = "runs", "windows"
"""Parts of the loop: what every run needs, and what makes stored steps again."""
PARTS = (FOR_RUNS, FOR_WINDOWS)
_REMEDY = (
    "It is the same for every scene, and compiled once: `python -m"
    " jointplay.solver.kernels.compile_loop` does that, then submit the job again"
)


def path_of(part: str) -> Path:
    """Return the file of a part's code, for this processor; it is the same for every width."""
    processor = replace(own_target(), lanes=1).mark
    return cache_folder() / f"loop-{part}-{version('numba')}-{processor}.o"


def begin(part: str) -> subprocess.Popen[bytes] | None:
    """Start compiling a part in a process of its own. Returns None where it is compiled."""
    if is_loaded(part) or path_of(part).exists():
        return None
    return subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-P", "-m", "jointplay.solver.kernels.compile_loop", part],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
    )


def wait_for(compiling: subprocess.Popen[bytes]) -> None:
    """Wait for what `begin` returned.

    Raises
    ------
    CompilationEnded
        Somebody watched, and it took too long or was not wanted any more; or it was killed.
    RuntimeError
        It failed.
    """
    attend(compiling, "the integration loop", _REMEDY)
    if compiling.returncode < 0:
        raise CompilationTooLong(
            "compile-memory",
            "The process that compiled the integration loop was killed, by signal"
            f" {-compiling.returncode}. It takes 0.6 GB of memory.",
        )
    if compiling.returncode > 0:
        raise RuntimeError("the integration loop could not be compiled; the log says why")


def address_in(part: str, symbol: str) -> int:
    """Return the address of a function of a part; half a minute where that is not compiled."""
    load_code(part, lambda: _code(part))
    return address_of_symbol(symbol)


def _code(part: str) -> bytes:
    compiling = begin(part)
    if compiling is not None:
        wait_for(compiling)
    return path_of(part).read_bytes()
