"""`python -m jointplay.solver.kernels.kernel_cache`: compile the driving loop into the cache.

It is the same for every scene; on a machine that has never computed, a second process compiles it
while the first compiles the scene's own kernel.
"""

import subprocess
import sys
from pathlib import Path

from filelock import FileLock

from jointplay.solver.integrators import AUTO, METHODS
from jointplay.solver.kernels.cache import cache_folder, without_collection
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kernels.loop.advance import advance
from jointplay.solver.kernels.loop.dense_rows import observe_rows
from jointplay.solver.kernels.watched import attend
from jointplay.solver.mechanics.tree import Tree, spanning_tree
from jointplay.solver.mechanics.view import form
from jointplay.solver.scene.document import Scene

_kernels: dict[tuple[str, Tree, str, str], Kernel] = {}
MOST_KEPT = 16
"""Kernels that a process keeps for the next job: recording the equations takes 20 ms and more."""


def compile_loop() -> None:
    """Compile what every run shares, or load it from the cache; only one process compiles."""
    with FileLock(_marker().with_suffix(".lock")), without_collection():
        advance.compile()
        observe_rows.compile()
    _marker().touch()


def compile_loop_aside() -> subprocess.Popen[bytes] | None:
    """Start compiling the loop in a process of its own; None when it is in the cache."""
    if _marker().exists():
        return None
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "jointplay.solver.kernels.kernel_cache"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def ready_kernel(scene: Scene, formulation: str, method: str = AUTO.name) -> Kernel:
    """Return the kernel of a scene's structure, the loop ready, too; seconds when not cached.

    `method` : a name of `solver.integrators.METHODS`.

    Raises
    ------
    LimitExceeded
        The scene's equations are too long to compile.
    CompilationEnded
        Somebody watched the compilation, and it took too long or was not wanted any more.
    """
    tree = spanning_tree(scene)
    key = (form(scene), tree, formulation, method)
    if key in _kernels:
        return _kernels[key]
    aside = compile_loop_aside()
    while len(_kernels) >= MOST_KEPT:
        _kernels.pop(next(iter(_kernels)))
    kernel = _kernels[key] = compile_kernel(scene, tree, formulation, METHODS[method])
    if aside is not None:
        attend(aside)
    return kernel


def _marker() -> Path:
    return cache_folder() / "loop-compiled"


if __name__ == "__main__":
    compile_loop()
