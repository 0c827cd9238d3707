"""Compilation of the program, in four fifths of the time that Numba takes unasked."""

from collections.abc import Callable
from typing import Any

from numba import njit


def compiled(function: Callable[..., Any]) -> Any:
    """Return a function that Python calls, too, compiled; what is divided by zero is infinite."""
    return njit(function, cache=True, error_model="numpy")


def compiled_inside(function: Callable[..., Any]) -> Any:
    """Return a function that compiled ones alone call, without what Python would need."""
    without = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return njit(function, cache=True, error_model="numpy", **without)
