"""Several processes that compute for a service elsewhere, a core each."""

import multiprocessing
import signal
import threading
import time
from multiprocessing.queues import SimpleQueue

from jointplay.worker.joined.connection import Connection, Refused
from jointplay.worker.joined.loop import work


def work_here(url: str, key: str | None, idle: float | None, until: float | None) -> int:
    """Compute blocks in this process, until a signal, a time [epoch s], or idleness; count them.

    Raises
    ------
    Refused
        The service does not take this worker.
    """
    draining = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: draining.set())
    if until is not None:
        timer = threading.Timer(max(until - time.time(), 0.0), draining.set)
        timer.daemon = True
        timer.start()
    connection = Connection(url, key)
    try:
        return work(connection, draining, idle)
    finally:
        connection.close()


def work_in(
    processes: int, url: str, key: str | None, idle: float | None, until: float | None
) -> int:
    """Do the same in several processes, to which signals are passed on.

    One that is lost, which a log tells, leaves its block to others.
    """
    if processes == 1:
        return work_here(url, key, idle, until)
    answers: SimpleQueue[int | str] = multiprocessing.SimpleQueue()
    asked = (answers, url, key, idle, until)
    children = [multiprocessing.Process(target=_answer, args=asked) for _ in range(processes)]
    for child in children:
        child.start()

    def pass_on(*_: object) -> None:
        for child in children:
            child.terminate()

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, pass_on)
    for child in children:
        child.join()
    blocks = 0
    while not answers.empty():
        answer = answers.get()
        if isinstance(answer, str):
            raise Refused(answer)
        blocks += answer
    if lost := [child.exitcode for child in children if child.exitcode]:
        raise Refused(f"{len(lost)} of {processes} processes were lost, after {blocks} blocks")
    return blocks


def _answer(answers: "SimpleQueue[int | str]", *asked: str | float | None) -> None:
    try:
        answers.put(work_here(*asked))  # type: ignore[arg-type]
    except Refused as refused:
        answers.put(str(refused))
