"""Integration methods: one file each, as data; this registry names them as jobs do."""

from jointplay.solver.integrators.bogacki_shampine3 import BOGACKI_SHAMPINE3
from jointplay.solver.integrators.dormand_prince853 import DORMAND_PRINCE853
from jointplay.solver.integrators.method import Method
from jointplay.solver.integrators.rodas4 import RODAS4
from jointplay.solver.integrators.runge_kutta4 import RUNGE_KUTTA4
from jointplay.solver.integrators.tsitouras5 import TSITOURAS5

METHODS: dict[str, Method] = {
    method.name: method
    for method in (BOGACKI_SHAMPINE3, TSITOURAS5, DORMAND_PRINCE853, RODAS4, RUNGE_KUTTA4)
}
"""Every method; one that is added here can be asked for by name in jobs and accuracy-studies."""

AUTO, COARSE, STIFF = TSITOURAS5, DORMAND_PRINCE853, RODAS4
"""Methods of ``auto``: as a rule, at tolerances too large for that, where a run is stiff."""


def method_for(method: str, tolerance: float | None) -> str:
    """Return the method of `METHODS` that a filled-in job means."""
    if method != "auto":
        return method
    within = tolerance is None or tolerance <= AUTO.largest_tolerance
    return AUTO.name if within else COARSE.name


__all__ = ["AUTO", "COARSE", "METHODS", "STIFF", "Method", "method_for"]
