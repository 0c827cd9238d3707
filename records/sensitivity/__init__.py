"""Sensitivity of a number to parameters that were drawn, from what the points of a design gave.

One file a design, named by this registry; `analysis` asks one of them about one output.
"""

from jointplay.records.sensitivity.design import Design
from jointplay.records.sensitivity.latin_hypercube import LatinHypercube
from jointplay.records.sensitivity.morris import Morris
from jointplay.records.sensitivity.saltelli import Saltelli

__all__ = ["DESIGNS", "Design"]

DESIGNS: dict[str, Design] = {
    "saltelli": Saltelli(),
    "morris": Morris(),
    "latin-hypercube": LatinHypercube(),
}
