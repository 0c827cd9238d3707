"""The explicit default beside the implicit method where friction is steep or contact is stiff.

    python -m benchmarks stiffness

Processor time of one bare run, kernels loaded, and the energy residual in units of tolerance times
gross work, of which 10 are allowed. The implicit method is shown at the same tolerance and at that
which `"auto"` gives it. Friction is full at ten times the static velocity.
"""

import time
from collections.abc import Iterator
from typing import Any

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.lane_results import ledger_of
from jointplay.solver.runs.stiff_method import EXPLICIT, IMPLICIT, TIGHTER

COLUMNS = ((EXPLICIT, 1.0), (IMPLICIT, 1.0), (IMPLICIT, TIGHTER))
TOLERANCES = (1e-6, 1e-8)
PRESETS = {"seven-bar-press": 0.5, "slider-crank": 0.05}
"""Simulated time, s."""
STATIC_VELOCITIES = (1e-5, 1e-6, 1e-7)
FRICTIONS = (0.1, 0.3)
STIFFNESSES = (1e12, 1e13)
PATIENCE = 20.0
"""Seconds of the processor that a run may take."""


def cases() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield presets and parameters."""
    for name in PRESETS:
        for friction in FRICTIONS:
            for slow in STATIC_VELOCITIES:
                velocities = {"static_velocity": slow, "dynamic_velocity": 10.0 * slow}
                yield name, {"friction": friction} | velocities
        for stiffness in STIFFNESSES:
            yield name, {"stiffness": stiffness, "friction": 0.1}


def measured(name: str, parameters: dict[str, Any], method: str, asked: float, share: float) -> str:
    """Return milliseconds and residual of a run at a share of the tolerance that was asked."""
    duration = PRESETS[name]
    scene = {"preset": name, "parameters": parameters}
    admission = admit({"kind": "simulate", "scene": scene, "duration": duration})
    assert isinstance(admission, Admission)
    found = admission.scene
    kernel = ready_kernel(found, "reduced", method, alone=True)
    problem = LaneProblem(found, duration, share * asked, duration, 0, 0, 0.0)
    bundle = Bundle(kernel, [problem], watch=False)
    begun, spent = time.process_time(), 0.0
    while bundle.advance(10_000) and spent < PATIENCE:
        spent = time.process_time() - begun
    spent = time.process_time() - begun
    if bundle.lane(0).status != Status.DONE:
        return f"over {spent:4.0f} s {'':7}"
    energy = ledger_of(bundle, 0)
    return f"{1e3 * spent:9.1f} {abs(energy['residual']) / (asked * energy['gross_work']):9.2g}"


def main() -> None:
    """Print the table."""
    heads = [f"{method} at {share:g}" for method, share in COLUMNS]
    measured("slider-crank", {}, EXPLICIT, 1e-6, 1.0)  # the first run of a process loads the loop
    print("tolerance, then ms and residual of", ", ".join(heads), "of it")
    for name, parameters in cases():
        print(name, " ".join(f"{key} {value:g}" for key, value in parameters.items()))
        for asked in TOLERANCES:
            columns = [
                measured(name, parameters, method, asked, share) for method, share in COLUMNS
            ]
            print(f"  {asked:7.0e}", *columns, flush=True)


if __name__ == "__main__":
    main()
