"""Several processes that compute for a service elsewhere, a core each."""

import ctypes
import logging
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.connection import wait
from typing import Any, Final

from jointplay.records.failure import InvalidInput
from jointplay.worker.holding import Refused
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from jointplay.worker.local.devices import PROCESSOR
from jointplay.worker.own_device import OwnDevice, tried_device
from jointplay.worker.process_name import has_ended, own_name

_SIGNALS: Final = (signal.SIGTERM, signal.SIGINT)
_LONGEST_SENTENCE: Final = 1000
_LOOK: Final = 1.0
"""Seconds after which it is looked again whether the process is there that began this one."""
_log = logging.getLogger(__name__)


class _Answer(ctypes.Structure):
    """Answer of one process, in memory that all share: no pipe that fills, no lock that is lost."""

    _fields_ = (("blocks", ctypes.c_longlong), ("refused", ctypes.c_char * _LONGEST_SENTENCE))


def work_here(
    url: str,
    key: str | None,
    idle: float | None,
    until: float | None,
    device: OwnDevice | None = None,
    parent: str | None = None,
) -> int:
    """Compute blocks in this process, until a signal, a time [epoch s], or idleness; count them.

    With the name of a `parent` also until that process has ended. `device` : what computes points
    of studies, if that is not the processor.

    Raises
    ------
    Refused
        The service does not take this worker.
    """
    draining = threading.Event()
    for number in _SIGNALS:
        signal.signal(number, lambda *_: draining.set())
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)
    if until is not None:
        timer = threading.Timer(max(until - time.time(), 0.0), draining.set)
        timer.daemon = True
        timer.start()
    if parent is not None:
        threading.Thread(target=_drain_without, args=(parent, draining), daemon=True).start()
    connection = Connection(url, key)
    try:
        return work(connection, draining, idle, device)
    finally:
        connection.close()


def _tried(device: str, processes: int) -> OwnDevice | None:
    try:
        return tried_device(device, processes)
    except InvalidInput as error:
        raise Refused(error.problems[0].detail.rstrip(".")) from error


def _tried_apart(device: str, processes: int) -> OwnDevice | None:
    """Return the same, tried by a process of its own: a fork does not take an open device along."""
    if device == PROCESSOR:
        return None
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(_tried, device, processes).result()


def _drain_without(parent: str, draining: threading.Event) -> None:
    """Give back what is computed when nobody is left who could say that it shall end."""
    begun_by = os.getppid()
    while not draining.wait(_LOOK):
        if has_ended(parent) or os.getppid() != begun_by:
            _log.warning("the process that began this one has ended")
            draining.set()


def work_in(
    processes: int,
    url: str,
    key: str | None,
    idle: float | None,
    until: float | None,
    device: str,
) -> int:
    """Do the same in several processes, to which signals are passed on.

    One that is lost, which a log tells, leaves its block to others; all end with this one. They
    share a `device`, see `Settings.device`, which is tried once.

    Raises
    ------
    Refused
        The service does not take this worker, or there is no such device.
    """
    if processes == 1:
        return work_here(url, key, idle, until, _tried(device, 1))
    answers = multiprocessing.RawArray(_Answer, processes)
    asked = (url, key, idle, until, _tried_apart(device, processes), own_name())
    children = [
        multiprocessing.Process(target=_answer, args=(answers, number, *asked))
        for number in range(processes)
    ]
    _begin(children)
    lost = _await(children)
    blocks: int = sum(answer.blocks for answer in answers)
    for answer in answers:
        if answer.refused:
            raise Refused(answer.refused.decode(errors="replace"))
    if lost:
        raise Refused(f"{lost} of {processes} processes were lost, after {blocks} blocks")
    return blocks


def _begin(children: Sequence[multiprocessing.Process]) -> None:
    """Start processes, and pass signals on to them."""

    def pass_on(*_: object) -> None:
        for child in children:
            if child.pid is not None:
                child.terminate()

    signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)  # they wait until all can hear them
    try:
        for child in children:
            child.start()
    except OSError:
        pass_on()
        raise
    finally:
        for number in _SIGNALS:
            signal.signal(number, pass_on)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)


def _await(children: Sequence[multiprocessing.Process]) -> int:
    """Return how many were lost when all have ended."""
    left = [*children]
    while left:
        ended = wait([child.sentinel for child in left])
        gone = [child for child in left if child.sentinel in ended]
        left = [child for child in left if child not in gone]
        for child in gone:
            child.join()
            if child.exitcode:
                _log.error("process %d was lost: its exit code is %d", child.pid, child.exitcode)
    return sum(bool(child.exitcode) for child in children)


def _answer(answers: Any, number: int, *asked: Any) -> None:
    try:
        answers[number].blocks = work_here(*asked)
    except Refused as refused:
        answers[number].refused = str(refused).encode()[: _LONGEST_SENTENCE - 1]
