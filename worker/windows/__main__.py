"""`python -m jointplay.worker.windows`: answers questions about trajectories, one at a time.

Receives each through the connection whose file descriptor is its argument; ends with the
connection, or after five minutes without a question.
"""

import sys
from contextlib import suppress
from multiprocessing.connection import Connection

from jointplay.worker.windows.evaluate import answer

_IDLE = 300.0  # s after which memory is given back


def main() -> None:
    """Answer until nobody asks any more."""
    with Connection(int(sys.argv[1])) as asking, suppress(EOFError, BrokenPipeError):
        while asking.poll(_IDLE):
            asking.send(answer(asking.recv()))


if __name__ == "__main__":
    main()
