"""`python -m jointplay.solver.kernels.device.loop_text FILE`: write the loop in LLVM's language.

Numba makes it, as it makes the loop of the CPU, but for no processor in particular, and without
vectors: so in a process of its own, for Numba is set when it is imported.
"""

# mypy: disable-error-code="no-untyped-call"

import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numba
from filelock import FileLock

from jointplay.solver.kernels.cache import cache_folder, without_collection, write_whole
from jointplay.solver.kernels.device.kernel_text import LOOP
from jointplay.solver.kernels.device.one_lane import SIGNATURE, advance_one_lane
from jointplay.solver.kernels.jit import INNER

SETTINGS = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
}


@cache
def loop_text() -> str:
    """Return the text; half a minute where it is not in the cache."""
    path = cache_folder() / f"device-loop-{numba.__version__}.ll"
    with FileLock(path.with_suffix(".lock")):
        if not path.exists():
            subprocess.run(  # noqa: S603 - our own program
                [sys.executable, "-P", "-m", __name__, str(path)],
                env=os.environ | SETTINGS,
                check=True,
            )
    return path.read_text()


def main(path: Path) -> None:
    """Write the text; the loop's name in it is `LOOP`."""
    with without_collection():
        compiled = numba.njit(SIGNATURE, **INNER)(advance_one_lane.py_func)
    overload: Any
    (overload,) = compiled.overloads.values()
    text = overload.library.get_llvm_str()
    text = text.replace(f"@{overload.fndesc.llvm_func_name}(", f"@{LOOP}(")
    write_whole(path, text.encode())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
