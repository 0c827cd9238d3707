"""`python -m jointplay.solver.kernels.compile_loop [PART ...]`: compile the loop into the cache.

It is the same for every scene, whose own equations take seconds: on a machine that has never
computed, a second process compiles it while the first compiles the scene's own kernel. Parts that
are named are compiled in this process; without any, those that are not in the cache yet, each in a
process of its own.
"""

import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from filelock import FileLock

from jointplay.solver.kernels.cache import cache_folder, without_collection
from jointplay.solver.kernels.jit import Deferred
from jointplay.solver.kernels.loop.advance import advance
from jointplay.solver.kernels.loop.dense_rows import observe_rows
from jointplay.solver.kernels.loop.extremes.window.extremes_in_steps import extremes_in_steps
from jointplay.solver.kernels.loop.periods import set_clocks
from jointplay.solver.kernels.loop.replay import find_steps, make_again, states_in_steps
from jointplay.solver.kernels.target import own_target

RUNS, WINDOWS = "runs", "windows"
PARTS: Mapping[str, Sequence[Deferred]] = {
    RUNS: (advance, observe_rows, set_clocks),
    WINDOWS: (extremes_in_steps, states_in_steps, make_again, find_steps),
}
"""Kernels that Python calls: what every run needs, and what makes stored steps again."""


def compile_part(part: str) -> None:
    """Compile a part, or load it from the cache; only one process compiles."""
    with FileLock(marker(part).with_suffix(".lock")), without_collection():
        for one in PARTS[part]:
            one.compile()
    marker(part).touch()


def begin(part: str) -> subprocess.Popen[bytes] | None:
    """Start compiling a part in a process of its own. Returns None where it is in the cache."""
    if marker(part).exists():
        return None
    return subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-P", "-m", "jointplay.solver.kernels.compile_loop", part],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def main(parts: Sequence[str]) -> int:
    """Compile the parts that are named, or all. Returns 1 if one does not compile, else 0."""
    for part in parts:
        compile_part(part)
    begun = [] if parts else [begin(part) for part in PARTS]
    codes = [one.wait() for one in begun if one is not None]
    return int(any(codes))


def marker(part: str) -> Path:
    """Return the file that says that a part is compiled for what this process is."""
    return cache_folder() / f"{part}-{own_target().mark}-compiled"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
