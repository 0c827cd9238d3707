"""Giving memory back to the system, which the C library would keep; glibc can be asked to."""

import ctypes
import threading
from contextlib import suppress

_M_MMAP_THRESHOLD = -3  # of malloc.h
_LARGE = 2**20  # bytes; event loops read into buffers of a quarter of this
_SOON = 10.0  # s


def keep_nothing_large() -> None:
    """Have what is larger than a mebibyte given back as soon as it is free.

    Otherwise glibc raises this limit to the largest piece that was ever freed, a body of megabytes.
    """
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).mallopt(_M_MMAP_THRESHOLD, _LARGE)


def give_back_soon() -> None:
    """Give back what many small pieces leave, when the request that made them has been answered."""
    timer = threading.Timer(_SOON, _give_back)
    timer.daemon = True
    timer.start()


def _give_back() -> None:
    """Take some milliseconds, in which other threads go on."""
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).malloc_trim(0)
