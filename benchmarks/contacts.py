"""Certified contacts of random jobs against those of far finer runs.

The truth is two runs by another method, which must agree on how many there are.
"""

import argparse
import json
from typing import Any

import numpy as np

from benchmarks.lies.contacts import contacts_hold
from benchmarks.lies.draw import anywhere
from benchmarks.lies.job import random_job
from benchmarks.lies.run import Finished, finish
from benchmarks.lies.scenes import SCENES

RUNS, SEED = 40, 7
FINER = ("dormand-prince-853", (1e-12, 1e-11))
MOST_STEPS = 600_000


def judged(job: dict[str, Any]) -> tuple[int, int, bool] | None:
    """Return how many contacts a job's certificate vouches for, of how many, and if it is right."""
    own = finish(job | {"certificate": True}, MOST_STEPS)
    if not isinstance(own, Finished) or own.certificate is None:
        return None
    method, tolerances = FINER
    plain = {name: job[name] for name in ("kind", "scene", "duration")} | {"certificate": False}
    finer = (finish(plain | {"method": method, "tolerance": one}, MOST_STEPS) for one in tolerances)
    truths = [run.onsets for run in finer if isinstance(run, Finished)]
    if len(truths) < len(tolerances):
        return None
    impacts = own.certificate.facts["impacts"]
    right = contacts_hold(impacts, own.onsets, (truths[0], truths[1]), job["duration"])
    return None if right is None else (impacts["certified"], impacts["count"], right)


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
