"""Functions of one argument: one file a function; this registry names them.

They prescribe motions and vary forces. What is evaluated is one of these, never a text.
"""

from jointplay.solver.laws.function.constant import Constant
from jointplay.solver.laws.function.law import Derivatives, Function
from jointplay.solver.laws.function.piecewise_polynomial import PiecewisePolynomial
from jointplay.solver.laws.function.polynomial import Polynomial
from jointplay.solver.laws.function.ramp import Ramp
from jointplay.solver.laws.function.sinusoidal import Sinusoidal
from jointplay.solver.laws.function.start_up import StartUp
from jointplay.solver.laws.function.table import Table

FUNCTIONS: dict[str, type[Function]] = {
    "constant": Constant,
    "polynomial": Polynomial,
    "piecewise-polynomial": PiecewisePolynomial,
    "sinusoidal": Sinusoidal,
    "ramp": Ramp,
    "start-up": StartUp,
    "table": Table,
}

__all__ = ["FUNCTIONS", "Derivatives", "Function"]
