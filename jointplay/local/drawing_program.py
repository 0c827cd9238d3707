"""Program of the drawing process: `python -m jointplay.local.drawing_program QUEUE`.

It loads matplotlib, then waits for one line on its standard input: the order, as JSON.  QUEUE is
the descriptor of an open pipe; each byte read from it is the index of a figure to draw now.  Once
the figure's file is written the same byte goes to standard output.
"""

import gc
import json
import os
import sys
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Final

_PATIENCE: Final = 60.0
"""Seconds without an order: after so long a run the time for figures does not count."""


def main(queue: int) -> None:
    """Get ready, wait for the order, draw what is left, and end without cleaning up."""
    gc.disable()  # a few figures, then it ends
    news = os.dup(1)
    os.dup2(2, 1)  # only figures are reported there
    orders: SimpleQueue[bytes] = SimpleQueue()
    Thread(target=_listen, args=(orders,), daemon=True).start()
    from jointplay import figures
    from jointplay.local import folder_results, load  # noqa: F401 - loaded while there is time

    figures.warm_up()
    with suppress(Empty):
        order = json.loads(orders.get(timeout=_PATIENCE))
        job = load(order["results"])
        while claim := os.read(queue, 1):
            name = order["names"][claim[0]]
            with suppress(Exception):  # the parent draws it again, and reports why not
                job.figure(name).save(f"{order['folder']}/{name}")
                os.write(news, claim)
    os._exit(0)


def _listen(orders: SimpleQueue[bytes]) -> None:
    """Pass the order on; end as soon as the process that could give one is gone."""
    orders.put(sys.stdin.buffer.readline())
    sys.stdin.buffer.read()
    os._exit(0)


if __name__ == "__main__":
    main(int(sys.argv[1]))
