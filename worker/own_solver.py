"""Solver of this process: its sources, and the class of the processor that it computes on."""

import ctypes
from functools import cache
from hashlib import sha256

from numpy.linalg import _umath_linalg

from jointplay.solver.kernels.lanes import target_processor
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import Solver


@cache
def own_solver() -> Solver:
    """Return the version, and the class as "NAME-DIGEST".

    That is the name of the processor that is compiled for, and eight digits of all that bits depend
    on: its features, and for which processor OpenBLAS chose its routines, which looks for itself.
    """
    name, features = target_processor()
    digest = sha256(f"{features} {_blas_processor()}".encode()).hexdigest()
    return Solver(SOLVER_VERSION, f"{name[:40]}-{digest[:8]}")


def _blas_processor() -> str:
    """Return the name of the processor that OpenBLAS is for; empty if NumPy has another library."""
    try:
        asked = ctypes.CDLL(_umath_linalg.__file__).scipy_openblas_get_corename64_
    except (OSError, AttributeError):
        return ""
    asked.restype = ctypes.c_char_p
    return str(asked().decode())
