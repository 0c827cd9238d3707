"""Embedded explicit Runge-Kutta methods: one file a tableau; this roster names them."""

from solver.integrators.tableau import Tableau
from solver.integrators.tsitouras5 import TSITOURAS5

METHODS: dict[str, Tableau] = {"tsitouras5": TSITOURAS5}
