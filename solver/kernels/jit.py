"""The decorators of hand-written kernels: cached on disk, IEEE division, no fast mathematics."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numba

from jointplay.solver.kernels.cache import cache_folder

cache_folder()  # names Numba's cache before any kernel is declared


COMPILED: dict[str, Any] = {"cache": True, "error_model": "numpy"}
INNER = COMPILED | {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def kernel() -> Callable[[Any], Any]:
    """Compile a function when another kernel or Python first uses it."""
    return numba.njit(**COMPILED)


def inner_kernel(*, forceinline: bool = False, borrows: bool = False) -> Callable[[Any], Any]:
    """Compile a function that kernels alone call, without what calls from elsewhere need.

    That is a quarter of its compilation. Called from Python it would be a null pointer.
    `forceinline` : for one that is called in one place, or takes more to call than to run.
    `borrows` : it makes no array and counts no references, which takes longer than short work does.
    """
    options: dict[str, Any] = INNER | {"forceinline": forceinline, "_nrt": not borrows}
    return numba.njit(**options)


def written_out() -> Callable[[Any], Any]:
    """Write a function into those that call it: only so may it return a tuple with a structure."""
    return numba.njit(inline="always", **INNER)


class Deferred:
    """A kernel of one signature, compiled or loaded at its first call: importing costs nothing."""

    def __init__(self, signature: Any, function: Callable[..., Any]) -> None:
        self.signature = signature
        self.function = function
        self._entry_point: Callable[..., Any] | None = None

    @cached_property
    def dispatcher(self) -> Any:
        """The compiled function, as Numba manages it."""
        return numba.njit(self.signature, **COMPILED)(self.function)

    def compile(self) -> Callable[..., Any]:
        """Return the compiled function; seconds when it is not in the cache.

        Its entry point is called directly, for looking up the types of all arguments took 70
        microseconds at every call: they must be of the declared types.
        """
        if self._entry_point is None:
            (compiled,) = self.dispatcher.overloads.values()
            self._entry_point = compiled.entry_point
        return self._entry_point

    def __call__(self, *arguments: Any) -> Any:
        """Run the kernel."""
        return self.compile()(*arguments)


def deferred(signature: Any) -> Callable[[Callable[..., Any]], Deferred]:
    """Declare a kernel that Python calls, with arguments of these types."""
    return lambda function: Deferred(signature, function)
