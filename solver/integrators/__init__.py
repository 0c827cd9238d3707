"""Integration methods: one file each, as data; this roster names them as jobs do."""

from jointplay.solver.integrators.bogacki_shampine3 import BOGACKI_SHAMPINE3
from jointplay.solver.integrators.dormand_prince853 import DORMAND_PRINCE853
from jointplay.solver.integrators.rodas4 import RODAS4
from jointplay.solver.integrators.rosenbrock import Rosenbrock
from jointplay.solver.integrators.runge_kutta4 import RUNGE_KUTTA4
from jointplay.solver.integrators.tableau import Tableau
from jointplay.solver.integrators.tsitouras5 import TSITOURAS5

Method = Tableau | Rosenbrock
EVERY: tuple[Method, ...] = (
    BOGACKI_SHAMPINE3,
    TSITOURAS5,
    DORMAND_PRINCE853,
    RODAS4,
    RUNGE_KUTTA4,
)
METHODS = {method.name: method for method in EVERY}


def method_for(method: str, tolerance: float | None) -> str:
    """Return the method of `METHODS` that a filled-in job means."""
    if method != "auto":
        return method
    within = tolerance is None or tolerance <= METHODS["tsitouras"].largest_tolerance
    return "tsitouras" if within else "dormand-prince-853"
