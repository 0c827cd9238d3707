"""The decorators of hand-written kernels: IEEE division, no fast mathematics.

Importing this sets how Numba compiles in this process. What it compiles is kept as machine code of
the whole loop: see `solver.kernels.loop_code`.
"""

from collections.abc import Callable
from typing import Any

import numba

from jointplay.solver.kernels.compiler import leave_out_slow_passes
from jointplay.solver.kernels.inner_functions import link_inner_functions

leave_out_slow_passes()
link_inner_functions()

COMPILED: dict[str, Any] = {"error_model": "numpy"}
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
