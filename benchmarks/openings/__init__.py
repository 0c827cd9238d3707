"""A search for openings of gaps that runs miss: ``python -m benchmarks openings``."""

from benchmarks.openings.command import main

__all__ = ["main"]
