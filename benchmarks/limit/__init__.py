"""How far kernels are from what the machine could do: the press written in C++, beside them."""

from benchmarks.limit.command import main

__all__ = ["main"]
