"""Solver of this process: its sources, and the class of machines whose bits it has."""

import ctypes
import platform
from functools import cache
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.linalg import _umath_linalg

from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import Solver


@cache
def own_solver() -> Solver:
    """Return the version, and the class as "MACHINE-DIGEST".

    Kernels have the same bits on every processor. What is left is what the libraries do that
    starts and indicators are computed with: for which processors OpenBLAS and NumPy chose their
    routines, and the C library.
    """
    libraries = (_blas_processor(), _numpy_routines(), *platform.libc_ver())
    digest = sha256(" ".join(libraries).encode()).hexdigest()
    return Solver(SOLVER_VERSION, f"{platform.machine()[:40]}-{digest[:8]}")


def _blas_processor() -> str:
    """Return the name of the processor that OpenBLAS is for; empty if NumPy has another library."""
    try:
        asked = ctypes.CDLL(_umath_linalg.__file__).scipy_openblas_get_corename64_
    except (OSError, AttributeError):
        return ""
    asked.restype = ctypes.c_char_p
    return str(asked().decode())


def _numpy_routines() -> str:
    """Return the version of NumPy, and the features of the processor that its routines use."""
    features: Any = np.show_config(mode="dicts")
    found = features.get("SIMD Extensions", {}).get("found", [])
    return " ".join([np.__version__, *found])
