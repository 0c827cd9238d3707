"""The process that draws beside another one: `python -m jointplay.local.drawing_process QUEUE`.

It loads what draws, and waits for one line on its standard input that says what there is to draw.
The queue is an open pipe: a byte of it is a figure that this process is to draw now.  Each figure
that is in its file goes to standard output, as the same byte.
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
"""Seconds without an order: after a run that long, nobody minds the time that figures take."""


def main(queue: int) -> None:
    """Get ready, wait for the order, draw what is left, and end without looking back."""
    gc.disable()  # a few figures, then it ends
    told = os.dup(1)
    os.dup2(2, 1)  # what others print is no news
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
            with suppress(Exception):  # who asked draws it again, and tells why that cannot be
                job.figure(name).save(f"{order['folder']}/{name}")
                os.write(told, claim)
    os._exit(0)


def _listen(orders: SimpleQueue[bytes]) -> None:
    """Pass the order on; end as soon as the process that could give one is gone."""
    orders.put(sys.stdin.buffer.readline())
    sys.stdin.buffer.read()
    os._exit(0)


if __name__ == "__main__":
    main(int(sys.argv[1]))
