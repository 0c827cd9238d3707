"""The service behind `running_service`: a process that ends with its standard input."""

import argparse
import sys
from pathlib import Path

from jointplay.service.processes import StartFailed, serve


def main() -> int:
    """Run a service on a free port, write its URL in the only line of output."""
    parser = argparse.ArgumentParser(
        prog="python -m jointplay.service.processes", description=__doc__
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--workers", type=int, default=1)
    given = parser.parse_args()
    pipe = sys.stdin.fileno()
    try:
        serve("127.0.0.1", 0, given.data, given.workers, as_json=True, parent_pipe=pipe)
    except StartFailed as failure:
        sys.stderr.write(f"{failure}\n")
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
