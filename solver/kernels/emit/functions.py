"""Compiled functions of a kernel, by name: one record of addresses, which compiled loops take."""

# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

from collections.abc import Mapping
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numba import float64, from_dtype, int64, types, void
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from jointplay.solver.kernels.jit import LaneFunction, kernel

WORK = float64[:, ::1]
"""Work array (slots, lanes)."""

OVER_LANES = types.FunctionType(void(WORK))
JUDGING = types.FunctionType(float64(WORK))
"""Attempts a step; the largest flag of a lane."""
MARKING = types.FunctionType(int64(WORK))
"""Looks at all channels; bit k is set for lane k where one may have passed an extreme."""
WITHIN_STEP = types.FunctionType(void(WORK, WORK, int64))
"""Evaluates instants inside the step of one lane of its first argument, into its second."""

SIGNATURES: Mapping[str, types.FunctionType] = {
    "right_hand_side": OVER_LANES,
    "attempt": JUDGING,
    "remember": OVER_LANES,
    "take": OVER_LANES,
    "weigh": OVER_LANES,
    "observe": OVER_LANES,
    "observe_rest": OVER_LANES,
    "scan": MARKING,
    "scan_some": MARKING,
    "states_within": WITHIN_STEP,
    "gaps_within": WITHIN_STEP,
    "channels_within": WITHIN_STEP,
    "channels_around": WITHIN_STEP,
    "tangent_step": OVER_LANES,
    "tangent_gaps": OVER_LANES,
}
"""Every function that the loop calls."""
OF_TANGENTS = ("tangent_step", "tangent_gaps")

DTYPE = np.dtype([(name, np.int64) for name in SIGNATURES])
ADDRESSES = from_dtype(DTYPE)[::1]
"""How kernels take the record: an array of one. First-class functions as arguments cost 5 us each
at every call from Python."""


def addresses_of(*modules: ModuleType) -> NDArray[np.void]:
    """Return the addresses of modules' functions by name, (1,); 0 where no module has one.

    Raises
    ------
    TypeError
        A function has another signature than the loop calls it with.
    """
    addresses = np.zeros(1, DTYPE)
    for module in modules:
        for name, expected in SIGNATURES.items():
            function = getattr(module, name, None)
            if function is not None:
                addresses[name] = address_of(function, expected)
    missing = [n for n in SIGNATURES if not addresses[n][0] and n not in OF_TANGENTS]
    if missing:
        raise TypeError(f"the kernel has no function {', '.join(missing)}")
    return addresses


def address_of(function: Any, expected: types.FunctionType) -> int:
    """Return the address of a compiled function of the expected signature."""
    compiled = next(iter(function.overloads.values()))
    if not expected.check_signature(compiled.signature):
        raise TypeError(f"{function.__name__} is {compiled.signature}, not {expected}")
    name = compiled.fndesc.llvm_cfunc_wrapper_name
    return int(compiled.library.get_pointer_to_function(name))


def _callable(kind: types.FunctionType) -> Any:
    """Return what makes an address a function of this kind, inside kernels."""

    def at_address(_typing: Any, address: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            function = cgutils.create_struct_proxy(kind)(context, builder)
            null = cgutils.voidptr_t(None)
            function.c_addr = builder.inttoptr(arguments[0], cgutils.voidptr_t)
            function.py_addr = function.jit_addr = null
            return function._getvalue()

        return kind(address), generate

    return intrinsic(at_address)


over_lanes = _callable(OVER_LANES)
judging = _callable(JUDGING)
marking = _callable(MARKING)
within_step = _callable(WITHIN_STEP)


class Functions(NamedTuple):
    """Functions that `advance` calls, as it calls them."""

    attempt: LaneFunction
    remember: LaneFunction
    take: LaneFunction
    weigh: LaneFunction
    observe: LaneFunction
    scan: LaneFunction
    scan_some: LaneFunction
    states_within: LaneFunction
    gaps_within: LaneFunction
    channels_within: LaneFunction
    channels_around: LaneFunction
    tangent_step: LaneFunction
    tangent_gaps: LaneFunction


@kernel()
def functions_at(addresses: np.ndarray) -> Functions:
    """Return the functions at a record of addresses, in kernels."""
    at = addresses[0]
    return Functions(
        attempt=judging(at.attempt),
        remember=over_lanes(at.remember),
        take=over_lanes(at.take),
        weigh=over_lanes(at.weigh),
        observe=over_lanes(at.observe),
        scan=marking(at.scan),
        scan_some=marking(at.scan_some),
        states_within=within_step(at.states_within),
        gaps_within=within_step(at.gaps_within),
        channels_within=within_step(at.channels_within),
        channels_around=within_step(at.channels_around),
        tangent_step=over_lanes(at.tangent_step),
        tangent_gaps=over_lanes(at.tangent_gaps),
    )
