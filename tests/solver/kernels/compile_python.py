"""`python -m tests.solver.kernels.compile_python FILE`: run Python as if it were a compilation."""

import sys
from pathlib import Path

from jointplay.solver.kernels import compile_file


def run(file: Path) -> None:
    exec(file.read_text(), {})


if __name__ == "__main__":
    compile_file.compile_file = run
    sys.exit(compile_file.main(Path(sys.argv[1])))
