"""`python -m worker.warm`: compile the kernels of every preset, while an image is built."""

import sys
import time

from solver import presets
from solver.admission import admit
from solver.simulate import Simulation


def warm(name: str) -> float:
    """Compile or load the kernels of a preset by a very short run; return the seconds."""
    began = time.perf_counter()
    job = {"kind": "simulate", "scene": {"preset": name}, "duration": 1e-3}
    for _ in Simulation(admit(job)).slices():
        pass
    return time.perf_counter() - began


def main() -> None:
    """Warm every preset and say how long each took."""
    for name in presets.names():
        sys.stdout.write(f"{name}: {warm(name):.1f} s\n")


if __name__ == "__main__":
    main()
