"""A campaign in a process of its own: its plan as JSON in, its report as JSON out.

When its standard input ends, as it does with the process that started it, it ends what it has
started, and then itself.
"""

import json
import os
import signal
import sys
import threading
from pathlib import Path
from typing import Final

from jointplay.chaos.campaign import campaign
from jointplay.command_line.exits import Exit

_LEFT_ALONE: Final = signal.SIGUSR1
"""Unlike SIGTERM, no computation takes it for a question that it answers later."""


def main() -> None:
    """Carry out the plan of the first argument; the folder in it is there, and empty."""
    signal.signal(_LEFT_ALONE, signal.default_int_handler)
    threading.Thread(target=_end_with_input, daemon=True).start()
    plan = json.loads(sys.argv[1])
    folder = Path(plan.pop("folder"))
    try:
        report = campaign(folder, **plan, tell=_tell)
    except KeyboardInterrupt:
        sys.exit(Exit.INTERRUPTED)
    sys.stdout.write(json.dumps(report.document()) + "\n")


def _end_with_input() -> None:
    os.read(sys.stdin.fileno(), 1)
    signal.pthread_kill(threading.main_thread().ident or 0, _LEFT_ALONE)


def _tell(line: str) -> None:
    sys.stderr.write(line + "\n")
    sys.stderr.flush()


if __name__ == "__main__":
    main()
