"""Three mechanisms on a graphics processor: their bits, and revolutions a second."""

from benchmarks.device.command import main

__all__ = ["main"]
