"""Verdicts of random points beside those of programs that share nothing with the solver."""

from benchmarks.verdicts.run import main

__all__ = ["main"]
