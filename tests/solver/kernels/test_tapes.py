"""Functions of tapes: compiled once, whoever calls them."""

from typing import Any

import numpy as np
from numba import njit, void

from jointplay.solver.kernels.emit.functions import WORK
from jointplay.solver.kernels.emit.tapes import Tapes
from jointplay.solver.kernels.lanes import LANES

SQUARED = "v0 = load 0\nv1 = mul v0 v0\nstore 1 v1"


def test_a_tape_is_in_one_library_and_its_callers_have_none_of_its_code() -> None:
    tapes = Tapes()
    square, define_all = tapes.add("square", SQUARED, "lanes"), tapes.definitions()
    defined = njit(void())(lambda: define_all())
    once = njit(void(WORK))(lambda work: square(work))
    twice = njit(void(WORK))(lambda work: (once(work), square(work), None)[2])
    multiplying = [
        "fmul" in code for one in (defined, once, twice) for code in one.inspect_llvm().values()
    ]
    assert multiplying == [True, False, False]
    for function in (once, twice):
        work = np.full((2, LANES), 3.0)
        function(work)
        assert work[1].tolist() == [9.0] * LANES


def compiled(tape: str) -> Any:
    """Return a kernel that does what a tape says, which every module here calls the same."""
    tapes = Tapes()
    run, define_all = tapes.add("square", tape, "lanes"), tapes.definitions()
    njit(void())(lambda: define_all())
    return njit(void(WORK))(lambda work: run(work))


def test_tapes_of_one_name_in_two_modules_are_two() -> None:
    functions = [compiled(SQUARED), compiled(SQUARED.replace("mul", "add"))]
    for function, expected in zip(functions, (9.0, 6.0), strict=True):
        work = np.full((2, LANES), 3.0)
        function(work)
        assert work[1].tolist() == [expected] * LANES
