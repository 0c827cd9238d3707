"""Giving memory back to the system: what caches keep unused, and what the C library would keep."""

import ctypes
import gc
import threading
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from functools import _lru_cache_wrapper

    Cached = TypeVar("Cached", bound=_lru_cache_wrapper[Any])

_M_MMAP_THRESHOLD = -3  # of malloc.h
_LARGE = 2**20  # bytes; event loops read into buffers of a quarter of this
_OFTEN = 15.0  # s


_caches: "dict[_lru_cache_wrapper[Any], int]" = {}
"""Each with the calls that it had had when it was looked at last."""


def let_go_when_unused(cache: "Cached") -> "Cached":
    """Have a cache emptied when nobody has asked it for a quarter of a minute."""
    _caches[cache] = 0
    return cache


def empty_unused_caches() -> None:
    """Empty the caches that nobody has asked since the last call."""
    emptied = False
    for cache, before in _caches.items():
        found = cache.cache_info()
        unused = found.hits + found.misses == before
        if unused and found.currsize:
            cache.cache_clear()
            emptied = True
        _caches[cache] = 0 if unused else found.hits + found.misses
    if emptied:  # readers refer to themselves, which only the collector finds
        gc.collect()


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
            empty_unused_caches()
            library.malloc_trim(0)
