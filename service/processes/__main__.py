"""The service behind `running_service`: a process that ends with its standard input."""

import argparse
import logging
import sys
from pathlib import Path

from jointplay.service.processes.child import StartFailed
from jointplay.service.processes.supervisor import Supervisor


def main() -> int:
    """Run a service on a free port, write its URL as the only line of output."""
    parser = argparse.ArgumentParser(
        prog="python -m jointplay.service.processes", description=__doc__
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--workers", type=int, default=1)
    arguments = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(message)s")

    def announce(url: str) -> None:
        sys.stdout.write(url + "\n")
        sys.stdout.flush()

    data, workers = arguments.data, arguments.workers
    try:
        supervisor = Supervisor("127.0.0.1", 0, data, workers, parent_pipe=sys.stdin.fileno())
        supervisor.run(announce)
    except StartFailed as failure:
        sys.stderr.write(f"{failure}\n")
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
