"""A compiled function of a kernel, as Python calls it and as loops find it."""

import ctypes
from functools import cached_property
from typing import Any

import numpy as np
from numba import float64, int64, types

from jointplay.solver.kernels.emit.functions import WORK
from jointplay.solver.kernels.emit.machine_code import address_of_symbol

ARRAY, INDEX = "ptr", "i64"
"""LLVM's types of arguments."""
OF_ARRAYS = ".of_arrays"
"""Ends the name of the function that takes arrays instead of addresses of numbers."""
CALLS = ".calls"
"""Ends the name of the number of its calls."""
VALUES = {
    "void": (types.void, None),
    "double": (float64, ctypes.c_double),
    "i64": (int64, ctypes.c_int64),
}
"""Types of a function's value for Numba and for Python, by LLVM's."""


class Function:
    """A compiled function of work arrays and an index behind them."""

    def __init__(self, name: str, symbol: str, value: str, arguments: list[str]) -> None:
        """Name a function that is loaded.

        Parameters
        ----------
        symbol
            LLVM's name of it; that of the one that takes arrays ends with `OF_ARRAYS`.
        value, arguments
            LLVM's types.
        """
        self.__name__ = name
        self._symbol, self._value, self._arguments = symbol, value, arguments

    @property
    def signature(self) -> Any:
        """Numba's types of value and arguments, where loops call it."""
        return VALUES[self._value][0](*(WORK if a == ARRAY else int64 for a in self._arguments))

    @property
    def address(self) -> int:
        """Address that loops call."""
        return address_of_symbol(f"{self._symbol}{OF_ARRAYS}")

    @property
    def calls(self) -> int:
        """Number of calls by loops of this process: work is counted, for times depend on cores."""
        return ctypes.c_int64.from_address(address_of_symbol(f"{self._symbol}{CALLS}")).value

    @cached_property
    def _entry(self) -> Any:
        kinds = [ctypes.c_void_p if a == ARRAY else ctypes.c_int64 for a in self._arguments]
        kind = ctypes.PYFUNCTYPE(VALUES[self._value][1], *kinds)
        return kind(address_of_symbol(self._symbol))

    def __call__(self, *arguments: Any) -> Any:
        """Run the function; arrays must be contiguous floats, as work arrays are."""
        return self._entry(*map(_passed, arguments))


def _passed(argument: Any) -> int:
    if not isinstance(argument, np.ndarray):
        return int(argument)
    if argument.dtype != np.float64 or not argument.flags.c_contiguous:
        raise TypeError("kernels take contiguous arrays of floats")
    return int(argument.ctypes.data)
