"""Multipliers of orbits of random mechanisms beside differences of simulations.

The product's multipliers come from central differences of runs beside one another in one bundle.
Here each run is a simulation of its own, by another method, a tenth of the tolerance, at other
distances from the orbit: its section after a period is read from the results. Closed loops of ideal
joints are simulated by the other formulation, which has other coordinates. Multipliers agree if
they differ by less than both errors, that of these differences being twice how far those of other
distances are from the nearest, whose noise is largest.
"""

import argparse
import json
import time
from itertools import chain, cycle, islice
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from benchmarks.random_loops import LOOPS
from benchmarks.random_mechanisms import OSCILLATORS, Draw
from benchmarks.simulated_sections import SimulatedMap
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch, branches
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.kinds import admit

DISTANCES = 1e-3, 3e-4, 1e-4
"""Shares of the extent of each state."""
FAMILIES = OSCILLATORS | LOOPS
COSTLY = {"press, play"}
"""Families of which an orbit is drawn in every fourth round: it takes most of a minute."""


def orbit_of(drawn: dict[str, Any]) -> tuple[ContinuationStudy, Branch] | None:
    """Return a short branch that begins at an orbit, if there is one, and its study."""
    at = drawn["scene"]["parameters"][drawn["parameter"]]["default"]
    values = {"from": at, "to": at * 1.0001, "count": 2}
    job = {"kind": "continuation", "settle": 300, "values": values} | drawn
    study = admit(job)
    assert isinstance(study, ContinuationStudy)
    (branch,) = branches(run(job, processes=1).study())
    return None if branch.failure else (study, branch)


def multipliers(columns: dict[str, Floats]) -> Floats:
    """Return the product's multipliers of the first orbit, complex."""
    count = sum(name.endswith(".real") for name in columns)
    return np.array(
        [
            columns[f"multiplier_{k}.real"][0] + 1j * columns[f"multiplier_{k}.imaginary"][0]
            for k in range(1, count + 1)
        ]
    )


def compared(study: ContinuationStudy, branch: Branch) -> tuple[float, float]:
    """Return how far multipliers are apart, and what both errors allow."""
    columns = {one.name: values for one, values in branch.columns.items()}
    own, map_ = multipliers(columns), SimulatedMap.of(study, columns)
    *coarse, fine = (_largest(map_.derivative(share), len(own)) for share in DISTANCES)
    part = max(_apart(one, fine) for one in coarse)
    return _apart(own, fine), 2.0 * part + float(columns["multiplier_error"][0])


def _largest(derivative: Floats, count: int) -> Floats:
    """Return so many multipliers, the largest."""
    found = np.linalg.eigvals(derivative)
    return np.asarray(found[np.argsort(-np.abs(found))][:count])


def _matched(multipliers: Floats, like: Floats) -> Floats:
    """Return multipliers in the order of those that they are next to."""
    _, order = linear_sum_assignment(np.abs(like[:, None] - multipliers))
    return np.asarray(multipliers[order])


def _apart(multipliers: Floats, others: Floats) -> float:
    return float(np.abs(_matched(multipliers, others) - others).max())


def table(families: dict[str, Draw], orbits: int, seed: int) -> None:
    """Print each orbit whose multipliers are outside, and counts of each family."""
    random = np.random.default_rng(seed)
    ratios: dict[str, list[float]] = {name: [] for name in families}
    without, seconds = dict.fromkeys(families, 0), dict.fromkeys(families, 0.0)
    rounds = [list(families), *[[one for one in families if one not in COSTLY]] * 3]
    for name in islice(cycle(chain(*rounds)), orbits):
        found = None
        begun = time.process_time()
        while found is None:
            drawn = families[name](random)
            found = orbit_of(drawn)
            without[name] += found is None
        apart, allowed = compared(*found)
        ratios[name].append(apart / allowed)
        seconds[name] += time.process_time() - begun
        if apart > allowed:
            print(f"{name}: {apart:.1e} apart, {allowed:.1e} allowed; {json.dumps(drawn)}")
    for name, shares in ratios.items():
        outside = sum(one > 1.0 for one in shares)
        print(f"{name:20}{len(shares) - outside:5} within, {outside} outside,", end="")
        print(f" {without[name]} drawn without one; {seconds[name]:.0f} s", flush=True)
    every = [one for shares in ratios.values() for one in shares]
    print(f"distances by what is allowed: median {np.median(every):.2g}, worst {max(every):.2g}")


def main() -> None:
    """Print a table of oscillators, and one of closed loops."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--oscillators", type=int, default=200)
    parser.add_argument("--loops", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    for families, orbits in ((OSCILLATORS, given.oscillators), (LOOPS, given.loops)):
        if orbits:
            table(families, orbits, given.seed)


if __name__ == "__main__":
    main()
