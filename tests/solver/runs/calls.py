"""Functions for other processes; a module, because they import it."""

import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

Advance = Callable[[float], bool]


def doubled(number: int, advance: Advance) -> int:
    advance(0.5)
    return 2 * number


def noted(path: Path, word: str, _advance: Advance) -> None:
    with path.open("a") as file:
        file.write(f"{word} ")


def refused(reason: str, advance: Advance) -> None:
    raise ValueError(reason)


def endless(advance: Advance) -> str:
    while advance(0.25):
        time.sleep(0.01)  # work that takes no processor from the others
    return "left"


def killed(advance: Advance) -> None:
    os.kill(os.getpid(), signal.SIGKILL)
