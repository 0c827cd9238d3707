"""Searches for lies: claims of a result that an independent program or a finer look contradicts."""

from benchmarks.lies.command import main

__all__ = ["main"]
