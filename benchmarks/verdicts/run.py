"""Random points judged as charts judge them, and again: how many verdicts are wrong, or missing."""

import argparse
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.verdicts.mechanisms import Mechanism, Oscillator, Pendulum, SliderCrank
from benchmarks.verdicts.truth import LENGTHS, UNCLEAR, judged
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.motion import motions, name_of

BESIDE = 5e-3
"""Share of a parameter's range: points whose neighbours at this distance are alike lie away from
boundaries."""
POINTS: dict[str, int] = {"pendulum": 220, "oscillator": 220, "crank": 60}
OF_CHARTS: dict[str, Any] = {"kind": "poincare", "indicators": ["lyapunov", "recurrence"]}
"""A point of a chart has the bits of this job: 100 periods to settle, 50 sections."""
FINER: dict[str, Any] = {
    "kind": "poincare",
    "indicators": ["zero_one", "recurrence"],
    "method": "dormand-prince-853",
    "tolerance": 1e-11,
    "settle": 300,
    "record": 500,
}
"""By the solver itself: another method, a hundredth of the tolerance, ten times the sections, and
another indicator of chaos."""


def drawn(ranges: tuple[tuple[float, float], ...], count: int, seed: int) -> Floats:
    """Return (count, 2) random points."""
    ends = np.array(ranges, np.float64)
    low, high = ends[:, 0], ends[:, 1]
    return low + (high - low) * np.random.default_rng(seed).random((count, 2))


def verdict(job: dict[str, Any]) -> tuple[str, Any]:
    """Return the motion that a job's point was judged to be, and its results."""
    study = run(job, processes=1).study()
    period = study.indicators["period"]
    (code,) = motions(study.status, study.indicators["verdict"], period, study.verdict_names)
    return name_of(int(code)), study


def by_another_program(mechanism: Mechanism, count: int, seed: int) -> Counter[str]:
    """Return how often verdicts are right, wrong or missing by an independent program."""
    found: Counter[str] = Counter()
    turns = mechanism.observables[0].endswith(".theta")
    widths = [high - low for low, high in mechanism.ranges]
    for values in drawn(mechanism.ranges, count, seed):
        job = OF_CHARTS | {"scene": mechanism.scene(values)}
        said, study = verdict(job | {"observables": list(mechanism.observables)})
        sections = np.stack([study.sections(name)[0] for name in mechanism.observables], axis=1)
        apart = sections[mechanism.apart(sections)]
        if not len(apart):  # it touches at every section: the program cannot go on from there
            found += Counter({"points": 1, "not judged": 1})
            continue
        last = apart[-1]
        told = []
        for shift in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            position = values + BESIDE * np.array(shift) * widths
            motion = mechanism.motion(position, last, LENGTHS[shift != (0, 0)])
            told.append(judged(*motion, mechanism.scales(position), turns))
        (true, right), *beside = told
        found += noted(said, true, right, away=all(one == true for one, _ in beside))
        if said not in ("undecided", *right) and true != UNCLEAR:
            print(f"  wrong: {said} at {values.tolist()}, it is {true}")
    return found


def noted(said: str, true: str, right: set[str], *, away: bool) -> Counter[str]:
    """Return one point's counts."""
    kind = "undecided" if said == "undecided" else "right" if said in right else "wrong"
    if true == UNCLEAR:
        kind = "undecided" if said == "undecided" else "not judged"
    found = Counter({kind: 1, "points": 1})
    if away and true != UNCLEAR:
        found += Counter({"away": 1, "undecided away": int(kind == "undecided")})
    return found


def by_itself(count: int, seed: int) -> Counter[str]:
    """Return the same of the slider-crank, by finer and longer runs of the solver."""
    found: Counter[str] = Counter()
    mechanism = SliderCrank()
    for values in drawn(mechanism.ranges, count, seed):
        scene = {"scene": mechanism.scene(values)}
        said, _ = verdict(OF_CHARTS | scene)
        true = finer(FINER | scene)
        found += noted(said, true, {true}, away=False)
        if said not in ("undecided", true) and true != UNCLEAR:
            print(f"  wrong: {said} at {values.tolist()}, finer runs say {true}")
    return found


def finer(job: dict[str, Any]) -> str:
    """Return the motion by recurrence, or where nothing recurs by the 0-1 test."""
    told = run(job, processes=1).study().indicators
    period, growth = (told[name][0] for name in ("period", "zero_one"))
    if period >= 1.0:
        return f"period-{period:.0f}"
    return "chaotic" if growth > 0.9 else "quasi-periodic" if growth < 0.1 else UNCLEAR


def main() -> None:
    """Print how many verdicts of each mechanism are right, wrong or missing."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    for name, count in POINTS.items():
        parser.add_argument(f"--{name}", type=int, default=count)
    given = parser.parse_args()
    titles = ("points", "right", "wrong", "undecided", "not judged", "away", "undecided away")
    print(f"{'':18}" + "".join(f"{title:>15}" for title in titles) + f"{'seconds':>9}")
    seed = given.seed
    judges: dict[str, Callable[[], Counter[str]]] = {
        "driven pendulum": lambda: by_another_program(Pendulum(), given.pendulum, seed),
        "impact oscillator": lambda: by_another_program(Oscillator(), given.oscillator, seed),
        "slider-crank": lambda: by_itself(given.crank, seed),
    }
    for name, judge in judges.items():
        begun = time.perf_counter()
        found = judge()
        took = time.perf_counter() - begun
        print(f"{name:18}" + "".join(f"{found[one]:15d}" for one in titles) + f"{took:9.0f}")


if __name__ == "__main__":
    main()
