"""Extremes of drafts against those of fine runs, over the presets and random jobs.

A draft counts where its own certificate calls the motion converged to the end: what else is wrong
then, its long steps did. Errors are shares of the channel's range in the fine run.
"""

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np

from benchmarks.lies.draw import anywhere
from benchmarks.lies.job import random_job
from benchmarks.lies.run import Finished, finish
from benchmarks.lies.scenes import OTHERS, SCENES
from jointplay.solver.runs.certificate.kinds import FORCE, UNITS

RUNS, SEED = 100, 5
SHOWN = (0.5, 0.9, 0.99, 1.0)
"""Shares of the channels."""
TENTH = 0.1
CONSTANT = 1e-9
"""A range below this share of the largest of its unit is rounding."""


def jobs(seed: int) -> Iterator[dict[str, Any]]:
    """Yield random jobs without an accuracy."""
    random = np.random.default_rng(seed)
    while True:
        job = random_job(anywhere(random), [*SCENES, *OTHERS]).job
        yield {name: job[name] for name in ("kind", "scene", "duration")}


def errors(job: dict[str, Any]) -> dict[str, list[float]] | None:
    """Return the errors of a draft's extremes, larger of both of a channel, by kind of bar."""
    draft = finish(job | {"accuracy": "draft"})
    if not isinstance(draft, Finished) or draft.certificate is None:
        return None
    if draft.certificate.facts["horizon"] < job["duration"]:
        return None
    fine = finish(job | {"accuracy": "fine", "certificate": False})
    if not isinstance(fine, Finished):
        return None
    ranges = np.array([peak.maximum - peak.minimum for peak in fine.peaks.values()])
    units = np.array(fine.units)
    found: dict[str, list[float]] = {}
    for (name, true), unit, spread in zip(fine.peaks.items(), units, ranges, strict=True):
        if spread > CONSTANT * ranges[units == unit].max():
            said = draft.peaks[name]
            wrong = max(abs(said.minimum - true.minimum), abs(said.maximum - true.maximum))
            found.setdefault(UNITS.get(unit, FORCE), []).append(float(wrong / spread))
    return found


def main() -> None:
    """Print how far extremes of drafts are off."""
    options = argparse.ArgumentParser(prog="python -m benchmarks drafts", description=__doc__)
    options.add_argument("--runs", type=int, default=RUNS)
    options.add_argument("--seed", type=int, default=SEED)
    given = options.parse_args()
    every: dict[str, list[float]] = {}
    judged = 0
    for job in jobs(given.seed):
        if judged == given.runs:
            break
        found = errors(job)
        if found is None:
            continue
        judged += 1
        for kind, wrong in found.items():
            every.setdefault(kind, []).extend(wrong)
    print(f"{judged} drafts that are converged to their end, seed {given.seed}")
    print(f"kind      channels {''.join(f'{100 * one:>9g} %' for one in SHOWN)}   above a tenth")
    for kind, wrong in every.items():
        shares = "".join(f"{x:11.2g}" for x in np.quantile(wrong, SHOWN))
        print(f"{kind:9} {len(wrong):8} {shares} {np.mean(np.array(wrong) > TENTH):15.2%}")


if __name__ == "__main__":
    main()
