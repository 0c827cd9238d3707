"""The one decorator of hand-written kernels: cached on disk, IEEE division, no fast mathematics."""

from collections.abc import Callable
from typing import Any

import numba

from solver.compiler.cache import cache_folder

cache_folder()  # names Numba's cache before any kernel is declared


LaneFunction = Callable[..., Any]
"""A generated function of work arrays: first-class inside kernels."""


def kernel(signature: Any = None) -> Callable[[Any], Any]:
    """Compile a function: at once with a signature, else on first use."""
    decorator: Callable[[Any], Any] = numba.njit(signature, cache=True, error_model="numpy")
    return decorator
