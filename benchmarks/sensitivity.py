"""Indices and probabilities beside closed forms, and two clearances of the press."""

import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.analysis import SHARES, Question, sensitivity
from jointplay.solver.distributions import DISTRIBUTIONS
from tests.records.sensitivity.known_functions import (
    FOUR_BRANCHES,
    G_FUNCTION,
    ISHIGAMI,
    ISHIGAMI_VARIANCE,
    four_branches,
    g_function,
    ishigami,
    study_of,
)

ROWS = (2**8, 2**12, 2**16)
FEW_ROWS = (8, 32, 128, 512)
SEEDS = 200
PRESS: dict[str, Any] = {
    "kind": "sensitivity",
    "scene": {"preset": "seven-bar-press"},
    "parameters": {
        "clearance_A": {"distribution": "uniform", "low": 1e-4, "high": 5e-4},
        "clearance_B": {"distribution": "uniform", "low": 1e-4, "high": 3e-4},
    },
    "samples": 256,
    "periods": 1,
    "settle": 0.2,
    "channels": ["displacement"],
    "statistics": ["mean"],
}


def closed_forms(
    name: str, function: Callable[[Floats], Floats], known: Mapping[str, tuple[float, ...]]
) -> None:
    """Print indices of a function at several numbers of rows, with their errors."""
    parameters = len(known["total"])
    for rows in ROWS:
        begun = time.process_time()
        found = sensitivity(study_of(function, rows, parameters), Question())
        seconds = time.process_time() - begun
        variance = found["standard_deviation"] ** 2
        print(f"\n{name}, {rows} rows, {seconds:.2f} s: variance {variance:.8f}")
        print("index                exact         found      interval of 95 %")
        for index, exact in known.items():
            one = found["measures"][index]
            for at, expected in enumerate(exact):
                low, high = one["low"][at], one["high"][at]
                value = one["values"][at]
                print(
                    f"{index:12}{at + 1:2}  {expected:12.8f}  {value:12.8f}  {low:.4f} {high:.4f}"
                )


def branches() -> None:
    """Print the probability that a system of four branches fails."""
    normal = DISTRIBUTIONS["normal"].model_validate(
        {"distribution": "normal", "mean": 0.0, "standard_deviation": 1.0}
    )

    def system(p: float, shares: Floats) -> Floats:
        return four_branches(normal.quantiles(shares), p)

    print("\nfour branches, 65536 rows: exact, found, interval of 95 %")
    for p, exact in FOUR_BRANCHES.items():
        for design in ("saltelli", "latin-hypercube"):
            study = study_of(partial(system, p), 2**16, 2, design)
            one = sensitivity(study, Question(limit=0.0, failing="below"))["failure"]
            shown = f"{one['probability']:.6e}  {one['low']:.3e} {one['high']:.3e}"
            print(f"p = {p:g} {design:16} {exact:.6e}  {shown}")


def coverage() -> None:
    """Print how often intervals of 95 % contain indices and quantiles of Ishigami's function."""
    shares = np.random.default_rng(1).random((4_000_000, 3))
    known: dict[str, Any] = {name: np.array(exact) for name, exact in ISHIGAMI.items()}
    known["quantiles"] = np.quantile(ishigami(shares), SHARES)
    for rows in FEW_ROWS:
        inside = {name: np.zeros(len(exact)) for name, exact in known.items()}
        for seed in range(SEEDS):
            found = sensitivity(study_of(ishigami, rows, 3, seed=seed), Question())
            answers = found["measures"] | {"quantiles": found["quantiles"]}
            for name, exact in known.items():
                low, high = (np.array(answers[name][end], float) for end in ("low", "high"))
                inside[name] += ~(low > exact) & ~(high < exact)
        shown = {name: np.round(100.0 * one / SEEDS, 1).tolist() for name, one in inside.items()}
        print(f"{rows} rows, per cent of {SEEDS} designs whose interval has the truth: {shown}")


def press() -> None:
    """Print indices of the press beside the shares of a plane through its points."""
    begun = time.perf_counter()
    job = run(PRESS)
    points = job.study()
    print(f"\npress, {points.points} points in {time.perf_counter() - begun:.1f} s")
    for output in ("displacement.maximum", "displacement.mean"):
        found = job.sensitivity(output)
        first, total = (found["measures"][name]["values"] for name in ("first_order", "total"))
        heights = (
            points.statistics[output]
            if output.endswith("mean")
            else points.peaks("displacement").maximum
        )
        plane = np.column_stack([np.ones(points.points), points.values])
        slopes = np.linalg.lstsq(plane, heights, rcond=None)[0][1:]
        parts = (slopes * [4e-4, 2e-4]) ** 2
        for at, name in enumerate(found["parameters"]):
            share = f"share of a plane {parts[at] / parts.sum():.4f}"
            indices = f"S1 {first[at]:.4f}  ST {total[at]:.4f}"
            print(f"{output:21} {name}  slope {slopes[at]:+.4f}  {share}  {indices}")


def main() -> None:
    """Print everything."""
    print(f"variance of Ishigami: {ISHIGAMI_VARIANCE:.8f}")
    closed_forms("Ishigami", ishigami, ISHIGAMI)
    closed_forms("g-function", g_function, G_FUNCTION)
    branches()
    coverage()
    press()
