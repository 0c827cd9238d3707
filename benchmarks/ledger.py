"""Residual of the energy ledger in tolerances of the gross work, over random jobs, by method."""

import argparse
from typing import Any

import numpy as np

from benchmarks.lies.draw import anywhere
from benchmarks.lies.job import random_job
from benchmarks.lies.scenes import OTHERS, SCENES
from benchmarks.lies.tables import table
from jointplay.records.failure import SimulationFailed
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.certificate.remarks import USUAL
from jointplay.solver.runs.simulate import Simulation

RUNS, SEED, MOST_STEPS = 300, 3, 50_000
NO_WORK = 1e-12
"""Gross work of a run in which nothing happens, J: its residual is rounding."""


def lacking(job: dict[str, Any]) -> tuple[str, float] | None:
    """Return a job's method, and what its ledger lacks; none if that means nothing."""
    admission = admit(job | {"certificate": False})
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    try:
        for _ in simulation.slices():
            if simulation.summary().statistics["steps"] > MOST_STEPS:
                return None
    except SimulationFailed:
        return None
    found = simulation.summary().statistics
    if found["energy"] is None:  # drivers prescribe the motion
        return None
    gross, method = found["energy"]["gross_work"], found["method"]
    if gross < NO_WORK or METHODS[method].fixed_step:
        return None
    return method, abs(found["energy"]["residual"]) / gross / admission.tolerance


def main() -> None:
    """Print a row for each method, and the worst job."""
    options = argparse.ArgumentParser(prog="python -m benchmarks ledger", description=__doc__)
    options.add_argument("--runs", type=int, default=RUNS)
    options.add_argument("--seed", type=int, default=SEED)
    given = options.parse_args()
    random = np.random.default_rng(given.seed)
    found: dict[str, list[float]] = {}
    worst = (0.0, "")
    while sum(map(len, found.values())) < given.runs:
        chosen = random_job(anywhere(random), [*SCENES, *OTHERS])
        one = lacking(chosen.job)
        if one is None:
            continue
        method, times = one
        found.setdefault(method, []).append(times)
        worst = max(worst, (times, f"{chosen.kind}, {method}, {chosen.job['tolerance']:g}"))
    rows = [
        (
            method,
            str(len(values)),
            f"{np.median(values):.2g}",
            str(sum(value > USUAL for value in values)),
            f"{max(values):.3g}",
        )
        for method, values in sorted(found.items())
    ]
    print(table(("method", "runs", "median", f"above {USUAL:g}", "worst"), rows))
    print(f"The worst: {worst[0]:.3g} times, {worst[1]}")


if __name__ == "__main__":
    main()
