"""`python -m jointplay.solver.kernels.compile_file FILE`: compile a module into the cache."""

import os
import resource
import sys
import threading
from pathlib import Path

from jointplay.solver.kernels.emit.module import compile_file
from jointplay.solver.kernels.watched import MOST_MEMORY, OUT_OF_MEMORY


def main(path: Path) -> int:
    """Compile; end at once when the process that started this one does."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    most = MOST_MEMORY if hard == resource.RLIM_INFINITY else min(MOST_MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (most, hard))
    try:
        compile_file(path)
    except MemoryError:
        return OUT_OF_MEMORY
    return 0


def _end_with_parent() -> None:
    os.read(0, 1)  # not sys.stdin, whose lock may not be held when the interpreter ends
    os._exit(1)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
