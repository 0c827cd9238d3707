"""Solver of this process: its sources, and the class of machines whose bits it has."""

import platform
import sys
from functools import cache

from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import Solver


@cache
def own_solver() -> Solver:
    """Return the version, and the class as "MACHINE-PYTHON": what code is made for.

    All that makes a result is arithmetic of our own, with the same bits on every processor and
    with any C library. Python belongs to it, whose versions do not all add numbers alike.
    """
    return Solver(SOLVER_VERSION, f"{platform.machine()[:40]}-{sys.implementation.cache_tag}")
