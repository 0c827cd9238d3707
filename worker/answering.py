"""The loop of a program that answers questions, one at a time, while somebody asks."""

import logging
import sys
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from jointplay.records.log_lines import begin
from jointplay.storage.settings import Settings


def answer_questions(answer: Callable[[Any], object], idle: float) -> None:
    """Answer what comes through the connection whose file descriptor is the program's argument.

    It sends None first, to say that it has started. Ends with the connection, or after `idle`
    seconds without a question: memory is given back.
    """
    begin(Settings().log_format, logging.WARNING)
    with Connection(int(sys.argv[1])) as asking, suppress(EOFError, BrokenPipeError):
        asking.send(None)
        while asking.poll(idle):
            asking.send(answer(asking.recv()))
