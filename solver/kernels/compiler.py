"""Settings of the compiler, LLVM: they hold for the whole process."""

from llvmlite import binding


def leave_order_to_processor() -> None:
    """Leave out the scheduling of instructions that follows the choice of registers.

    LLVM has it for some processors, AMD's among them. On a straight line of n statements it takes
    n^2 time, two thirds of compilation at n = 5000, and processors that execute out of order do as
    well without: kernels of the press are as fast. No result depends on the order.
    """
    binding.set_option("jointplay", "-disable-post-ra")
