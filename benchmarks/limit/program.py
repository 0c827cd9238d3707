"""The press in C++, built with the compiler that is found, and run in this process."""

import ctypes
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

SOURCE = Path(__file__).with_name("limit.cpp")
FLAGS = ("-std=c++20", "-O3", "-march=native", "-ffp-contract=fast", "-fno-math-errno")
SCALAR = "-fno-tree-slp-vectorize"
"""With pairs of its numbers in vectors the scalar program takes half as long again."""
WIDTHS = (1, 4, 8)
"""Runs side by side."""


def compiler() -> str | None:
    """Return the path of a C++ compiler: of $CXX, or of GCC or Clang; none if there is none."""
    names = filter(None, (os.environ.get("CXX"), "g++", "clang++", "c++"))
    return next(filter(None, map(shutil.which, names)), None)


class Program:
    """The program for a number of runs side by side."""

    def __init__(self, width: int, folder: Path, *, exact: bool = False) -> None:
        """Build it in a folder; `exact` : with sines to rounding at every stage.

        Raises
        ------
        FileNotFoundError
            There is no compiler.
        """
        found = compiler()
        if found is None:
            raise FileNotFoundError("There is no C++ compiler: install g++ or set CXX.")
        library = folder / f"limit{width}{'-exact' * exact}.so"
        flags = [*FLAGS, SCALAR] if width == 1 else [*FLAGS, "-Wno-psabi"]
        built = [
            found,
            *flags,
            f"-DWIDTH={width}",
            f"-DSINES={int(exact)}",
            "-shared",
            "-fPIC",
            "-o",
            str(library),
        ]
        subprocess.run([*built, SOURCE], check=True)
        self.width = width
        self._run = ctypes.CDLL(str(library)).run
        self._run.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_long, ctypes.c_long]
        self._run.restype = ctypes.c_long

    def advance(
        self, mechanism: NDArray[np.float64], presses: NDArray[np.void], budget: int = 10**9
    ) -> int:
        """Compute presses until all have ended, or for so many attempts; return how many.

        Records of `presses` are where their runs have come to, afterwards.
        """
        return int(self._run(mechanism.ctypes.data, presses.ctypes.data, len(presses), budget))
