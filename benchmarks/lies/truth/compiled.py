"""Compilation of the program, in four fifths of the time that Numba takes unasked."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


def compiled(function: Compiled) -> Compiled:
    """Return a function that Python calls, too, compiled; what is divided by zero is infinite."""
    return cast(Compiled, njit(function, cache=True, error_model="numpy"))


def compiled_inside(function: Compiled) -> Compiled:
    """Return a function that compiled ones alone call, without what Python would need."""
    without: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return cast(Compiled, njit(function, cache=True, error_model="numpy", **without))
