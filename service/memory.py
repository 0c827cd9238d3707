"""Giving memory back to the system, which the C library would keep; glibc can be asked to."""

import ctypes
import threading
import time
from contextlib import suppress

_M_MMAP_THRESHOLD = -3  # of malloc.h
_LARGE = 2**20  # bytes; event loops read into buffers of a quarter of this
_OFTEN = 15.0  # s


def keep_no_free_memory() -> None:
    """Have what is larger than a mebibyte given back as soon as it is free, the rest now and then.

    Otherwise glibc raises that limit to the largest piece that was ever freed, a body of megabytes,
    and keeps all the small pieces that a batch leaves.
    """
    with suppress(AttributeError, OSError):
        library = ctypes.CDLL(None)
        library.mallopt(_M_MMAP_THRESHOLD, _LARGE)
        threading.Thread(target=_trim, args=(library,), daemon=True).start()


def _trim(library: ctypes.CDLL) -> None:
    """Take some milliseconds every quarter of a minute, in which other threads go on."""
    with suppress(AttributeError):
        while True:
            time.sleep(_OFTEN)
            library.malloc_trim(0)
