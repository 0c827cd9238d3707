"""Certified contacts of random jobs against those of far finer runs.

Every pair must have as many contacts until `impacts.until`, each within `impacts.onset_error` of
its onset. The truth is two runs by another method, which must agree on how many there are.
"""

import argparse
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.lies.draw import anywhere
from benchmarks.lies.job import random_job
from benchmarks.lies.scenes import SCENES
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.simulate import Simulation

RUNS, SEED = 40, 7
FINER = ("dormand-prince-853", (1e-12, 1e-11))
MOST_STEPS = 600_000
ROUNDING = 1e-13
"""Share of a run's length."""

Onsets = dict[int, NDArray[np.float64]]


def onsets_of(job: dict[str, Any]) -> tuple[Onsets, Certificate | None] | None:
    """Return the onsets of each pair, s, ascending, and the certificate; none if the run failed."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation, impacts = Simulation(admission), []
    try:
        for piece in simulation.slices():
            impacts.append(piece.impacts)
            if simulation.summary().statistics["steps"] > MOST_STEPS:
                return None
    except SimulationFailed:
        return None
    every = np.concatenate(impacts)
    pairs = {int(pair) for pair in every["joint"]}
    found = {pair: np.sort(every["onset"][every["joint"] == pair]) for pair in pairs}
    return found, simulation.certificate()


def judged(job: dict[str, Any]) -> tuple[int, int, bool] | None:
    """Return how many contacts a job's certificate vouches for, of how many, and if it is right."""
    own = onsets_of(job | {"certificate": True})
    if own is None or own[1] is None or own[1].facts["impacts"] is None:
        return None
    method, tolerances = FINER
    plain = {name: job[name] for name in ("kind", "scene", "duration")} | {"certificate": False}
    fine, coarse = (onsets_of(plain | {"method": method, "tolerance": one}) for one in tolerances)
    if fine is None or coarse is None:
        return None
    impacts, right = own[1].facts["impacts"], True
    allowed = (impacts["onset_error"] or 0.0) + ROUNDING * job["duration"]
    for pair in {*own[0], *fine[0], *coarse[0]}:
        every = [found[0].get(pair, np.zeros(0)) for found in (own, fine, coarse)]
        said, true, doubted = (onsets[onsets <= impacts["until"]] for onsets in every)
        if len(true) != len(doubted):
            return None  # the truth is not known
        right &= len(said) == len(true) and bool(np.all(np.abs(said - true) <= allowed))
    return impacts["certified"], impacts["count"], right


def main() -> None:
    """Print how many contacts are certified, and jobs whose certificate is wrong."""
    options = argparse.ArgumentParser(prog="python -m benchmarks contacts", description=__doc__)
    options.add_argument("--runs", type=int, default=RUNS)
    options.add_argument("--seed", type=int, default=SEED)
    given = options.parse_args()
    random = np.random.default_rng(given.seed)
    found: list[tuple[int, int, bool]] = []
    while len(found) < given.runs:
        job = random_job(anywhere(random), list(SCENES)).job
        one = judged(job)
        if one is None:
            continue
        found.append(one)
        if not one[2]:
            print(json.dumps(job))
    certified, count, right = (sum(column) for column in zip(*found, strict=True))
    print(f"{right} of {given.runs} jobs right, seed {given.seed}: {certified} of {count} contacts")


if __name__ == "__main__":
    main()
