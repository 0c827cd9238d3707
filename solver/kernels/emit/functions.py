"""Compiled functions of a kernel: as Python calls them, and as loops do, by their addresses."""

import ctypes
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.machine_code import address_of_symbol

ARRAY, INDEX = "ptr", "i64"
"""LLVM's types of arguments: the address of an array's numbers, and an index behind arrays."""
VALUES = {"void": None, "i64": ctypes.c_int64}
"""Types of a function's value for Python, by LLVM's."""


class Signature(NamedTuple):
    """LLVM's types of a function's value and of its arguments."""

    value: str
    arguments: tuple[str, ...]


OVER_LANES = Signature("void", (ARRAY,))
"""Takes a work array (slots, lanes)."""
MARKING = Signature("i64", (ARRAY,))
"""Attempts a step, or looks at all lanes; bit k is set for lane k where something is found."""
WITHIN_STEP = Signature("void", (ARRAY, ARRAY, INDEX))
"""Evaluates instants inside the step of one lane of its first argument, into its second."""

SIGNATURES: Mapping[str, Signature] = {
    "right_hand_side": OVER_LANES,
    "attempt": MARKING,
    "remember": OVER_LANES,
    "remember_some": OVER_LANES,
    "take": OVER_LANES,
    "weigh": OVER_LANES,
    "observe": OVER_LANES,
    "observe_rest": OVER_LANES,
    "foresee_looks": MARKING,
    "foresee_bends": OVER_LANES,
    "scan": MARKING,
    "scan_some": MARKING,
    "states_within": WITHIN_STEP,
    "penetrations_within": WITHIN_STEP,
    "channels_within": WITHIN_STEP,
    "channels_around": WITHIN_STEP,
    "tangent_step": OVER_LANES,
    "tangent_penetrations": OVER_LANES,
}
"""Every function that loops call."""
OF_TANGENTS = ("tangent_step", "tangent_penetrations")

DTYPE = np.dtype([(name, np.int64) for name in SIGNATURES])
"""Type of their addresses; see `solver.kernels.loop.generated`."""


def addresses_of(*modules: Any) -> NDArray[np.void]:
    """Return the addresses of modules' functions by name, (1,); 0: no module has its tangents.

    Raises
    ------
    TypeError
        A function is missing, or has another signature than the loop calls it with.
    """
    addresses = np.zeros(1, DTYPE)
    for name, expected in SIGNATURES.items():
        found = [getattr(module, name) for module in modules if hasattr(module, name)]
        if found:
            addresses[name] = address_of(found[0], expected)
        elif name not in OF_TANGENTS:
            raise TypeError(f"the kernel has no function '{name}'")
    return addresses


def address_of(function: Any, expected: Signature) -> int:
    """Return the address of a compiled function of the expected signature."""
    if function.signature != expected:
        raise TypeError(f"'{function.__name__}' is {function.signature}, not {expected}")
    return int(function.address)


COUNTED = ".counted"
"""Ends the name of the function that loops call, which counts its calls."""
CALL_COUNT = ".call_count"
"""Ends the name of the number of its calls."""


class Function:
    """A compiled function of work arrays and an index behind them."""

    def __init__(self, name: str, symbol: str, signature: Signature) -> None:
        """Name a function that is loaded.

        `symbol` : LLVM's name of it; that of the one that loops call ends with `COUNTED`.
        """
        self.__name__ = name
        self.signature = signature
        self._symbol = symbol

    @property
    def address(self) -> int:
        """Address that loops call."""
        return address_of_symbol(f"{self._symbol}{COUNTED}")

    @property
    def call_count(self) -> int:
        """Number of calls by loops of this process: work is counted, for times depend on cores."""
        return ctypes.c_int64.from_address(address_of_symbol(f"{self._symbol}{CALL_COUNT}")).value

    @cached_property
    def _entry(self) -> Any:
        value, arguments = self.signature
        kinds = [ctypes.c_void_p if a == ARRAY else ctypes.c_int64 for a in arguments]
        kind = ctypes.PYFUNCTYPE(VALUES[value], *kinds)
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
