"""`python -m jointplay.solver.kernels.compile_loop [KERNEL ...]`: compile the loop, once for all.

The equations of a mechanism are compiled when it is first run, in seconds; the loop around them is
the same for all, and takes most of a minute of processor time. Where it is in the cache already,
nothing is done. Kernels that are named are compiled in this process, else each in its own.
"""

import subprocess
import sys
from collections.abc import Sequence

from jointplay.solver.kernels.cache import cache_folder
from jointplay.solver.kernels.jit import Deferred
from jointplay.solver.kernels.loop import advance, dense_rows, extremes_in_steps, replay

LONGEST_FIRST = (
    advance.advance,
    extremes_in_steps.extremes_in_steps,
    replay.states_in_steps,
    dense_rows.observe_rows,
    replay.works_in_steps,
    replay.step_ends,
    replay.find_steps,
)
"""The kernels that Python calls; what they call is compiled with them."""
APART = 1
"""Number of them that have a process of their own; the rest take a fifth of the time, together."""


def main(names: Sequence[str]) -> int:
    """Compile the named kernels, or all of them; 0 if that went well."""
    kernels: dict[str, Deferred] = {one.function.__name__: one for one in LONGEST_FIRST}
    if names:
        for name in names:
            kernels[name].compile()
        return 0
    mark = cache_folder() / "loop.compiled"
    if mark.exists():
        return 0
    every = list(kernels)
    parts = [*([name] for name in every[:APART]), every[APART:]]
    command = [sys.executable, "-P", "-m", "jointplay.solver.kernels.compile_loop"]
    begun = [subprocess.Popen([*command, *part]) for part in parts]  # noqa: S603  (our own)
    codes = [one.wait() for one in begun]
    if any(codes):
        return 1
    mark.touch()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
