"""Functions that kernels alone call have no machine code of their own."""

from typing import Any

import numba

from jointplay.solver.kernels.jit import INNER


@numba.njit(**INNER)
def doubled(number: float) -> float:
    return 2.0 * number


@numba.njit(**INNER)
def next_to_doubled(number: float) -> float:
    return doubled(number) + 1.0


@numba.njit
def called(number: float) -> float:
    return next_to_doubled(number) ** 2


def code_of(function: Any) -> int:
    """Return the address of what was compiled for one signature; 0 if there is none."""
    (compiled,) = function.overloads.values()
    return int(compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name))


def test_what_kernels_alone_call_is_code_in_its_callers_only() -> None:
    assert called(1.0) == 9.0
    assert code_of(called) != 0
    assert [code_of(one) for one in (doubled, next_to_doubled)] == [0, 0]


def test_they_are_written_into_it() -> None:
    assert called(2.0) == 25.0
    (compiled,) = called.overloads.values()
    name = compiled.fndesc.llvm_func_name
    text = compiled.library.get_llvm_str()
    (body,) = [part for part in text.split("\ndefine ") if f"@{name}(" in part.partition("{")[0]]
    assert " call " not in body.partition("\n}")[0]
