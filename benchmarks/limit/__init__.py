"""Kernels beside what the machine could do: the press, written in C++."""

from benchmarks.limit.command import main

__all__ = ["main"]
