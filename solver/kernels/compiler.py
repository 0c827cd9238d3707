"""Settings of the compiler, LLVM: they hold for the whole process."""

from functools import cache

from llvmlite import binding

LEFT_OUT = ("-disable-post-ra", "-disable-vector-combine")
"""Passes whose time is the square of a straight line's length: see `leave_out_slow_passes`."""


@cache
def leave_out_slow_passes() -> None:
    """Leave out two passes that take the square of the time where a block is twice as long.

    The scheduling of instructions that follows the choice of registers, which LLVM has for some
    processors, AMD's among them: two thirds of compilation at n = 5000 statements. Processors that
    execute out of order do as well without. And the combination of operations on vectors, which is
    slow where numbers are spread over vectors, as inside steps: it numbers a block's instructions
    anew for each one that it changes. Kernels of the press are as fast without either. No result
    depends on them.
    """
    for option in LEFT_OUT:
        binding.set_option("jointplay", option)


def order_instructions(wanted: bool) -> None:
    """Say whether code that is generated from here on has its instructions put in a fast order.

    A press runs 2 to 8 % slower in the order in which it is written. No result depends on it.
    """
    binding.set_option("jointplay", f"-enable-misched={wanted:d}")
