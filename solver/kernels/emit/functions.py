"""Compiled functions of a kernel: as Python calls them, and as loops do, by their addresses."""

# mypy: disable-error-code="no-untyped-call"

import ctypes
from collections import namedtuple
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, cast

import numpy as np
from numba import float64, from_dtype, int64, types, void
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.machine_code import address_of_symbol

WORK = float64[:, ::1]
"""Work array (slots, lanes)."""

OVER_LANES = types.FunctionType(void(WORK))
MARKING = types.FunctionType(int64(WORK))
"""Attempts a step, or looks at all lanes; bit k is set for lane k where something is found."""
WITHIN_STEP = types.FunctionType(void(WORK, WORK, int64))
"""Evaluates instants inside the step of one lane of its first argument, into its second."""

SIGNATURES: Mapping[str, types.FunctionType] = {
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
    "gaps_within": WITHIN_STEP,
    "channels_within": WITHIN_STEP,
    "channels_around": WITHIN_STEP,
    "tangent_step": OVER_LANES,
    "tangent_gaps": OVER_LANES,
}
"""Every function that loops call."""
OF_TANGENTS = ("tangent_step", "tangent_gaps")

Functions = namedtuple("Functions", SIGNATURES)  # type: ignore[misc]  # noqa: PYI024
"""All of them, by name, inside compiled loops."""
DTYPE = np.dtype([(name, np.int64) for name in SIGNATURES])
ADDRESSES = from_dtype(DTYPE)[::1]
"""Type of the structure in loops: an array of one. First-class functions as arguments would cost
5 us each at every call from Python."""


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


def address_of(function: Any, expected: types.FunctionType) -> int:
    """Return the address of a compiled function of the expected signature."""
    if not expected.check_signature(function.signature):
        raise TypeError(f"'{function.__name__}' is {function.signature}, not {expected}")
    return int(function.address)


def _functions_at(_typing: Any, structure: Any) -> Any:
    """Return the functions whose addresses a structure has."""
    named = types.NamedTuple(list(SIGNATURES.values()), Functions)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        functions = []
        for name, kind in SIGNATURES.items():
            address = cgutils.get_record_member(builder, arguments[0], structure.offset(name), WORD)
            function = cgutils.create_struct_proxy(kind)(context, builder)
            function.c_addr = builder.inttoptr(builder.load(address), cgutils.voidptr_t)
            function.py_addr = function.jit_addr = cgutils.voidptr_t(None)
            functions.append(function._getvalue())
        return context.make_tuple(builder, named, functions)

    return named(structure), generate


WORD = cgutils.intp_t
functions_at = cast(Callable[[Any], Any], intrinsic(_functions_at))


ARRAY = "ptr"
"""LLVM's type of an array among arguments; the others are indices."""
OF_ARRAYS = ".of_arrays"
"""Ends the name of the function that takes arrays instead of addresses of numbers."""
CALLS = ".calls"
"""Ends the name of the number of its calls."""
VALUES = {
    "void": (types.void, None),
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
