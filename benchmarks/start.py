"""Time to a first result: the first run after installation, and the second one.

The first compiles everything into an empty cache; the second is a whole process again, from the
interpreter's start to its end: imports, one revolution of the press, the stored results.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPEATS = 5


def run(cache: str, out: Path) -> float:
    """Return the wall seconds of one `jointplay run` of the press."""
    command = [
        *(sys.executable, "-m", "jointplay", "run", "seven-bar-press"),
        *("--duration", "2", "-o", str(out)),
    ]
    begun = time.perf_counter()
    subprocess.run(
        command, check=True, capture_output=True, env=os.environ | {"JOINTPLAY_CACHE": cache}
    )
    return time.perf_counter() - begun


def main() -> None:
    """Print the times."""
    with tempfile.TemporaryDirectory() as folder:
        cache = str(Path(folder) / "cache")
        first = run(cache, Path(folder) / "first")
        seconds = [run(cache, Path(folder) / f"again{i}") for i in range(REPEATS)]
    print(f"first run, kernels compiled                  {first:6.2f} s")
    print(
        f"further runs, median of {REPEATS}                    {statistics.median(seconds):6.2f} s"
    )


if __name__ == "__main__":
    main()
