"""Designs of points in the unit cube: one file a design, as `records.sensitivity` reads them.

A member takes the number of rows, that of parameters, and a seed, and returns (rows, width,
parameters) shares of probability, each above 0 and below 1.
"""

from collections.abc import Callable

from jointplay.records.arrays import Floats
from jointplay.solver.designs.latin_hypercube import latin_hypercube
from jointplay.solver.designs.morris import morris
from jointplay.solver.designs.saltelli import saltelli

DESIGNS: dict[str, Callable[[int, int, int], Floats]] = {
    "saltelli": saltelli,
    "morris": morris,
    "latin-hypercube": latin_hypercube,
}
