"""Folds, doublings and grazing over speed and amplitude, beside Newton's law of impact.

`python -m benchmarks special_curves`. Curves of special orbits of the impact oscillator at two
stiffnesses of its stop, which leaves the share 0.8 of the speed, beside the closed forms of a rigid
one. Contact takes a time that falls as K^-0.4, by which fold and doubling are off; grazing does not
depend on the stop. Where doubling turns from hard to soft is extrapolated to a rigid stop.
"""

import time
from typing import Any

import numpy as np

from benchmarks import rigid_stop
from benchmarks.continuation import branch_job
from benchmarks.rigid_doublings import generalised_doubling
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import LENGTH, SECOND, SECOND_BOUND, VALUE, Branch, branches

STOPS = (1e10, 1e11)
"""N/m^1.5."""
AMPLITUDES = (3e-3, 2e-2)
"""m; below, impacts of the doubling are so slow that contact is no longer short."""
BRANCHES: dict[str, dict[str, Any]] = {
    "LP": {"values": {"from": 25.0, "to": 33.0, "count": 200}},
    "PD": {"values": {"from": 25.0, "to": 18.0, "count": 40}},
    "GR": {"values": {"from": 33.0, "to": 24.0, "count": 60}},
}
"""Ranges of speed, rad/s, with the special orbit that a branch over them has."""
KNOWN = {"LP": rigid_stop.fold, "PD": rigid_stop.doubling, "GR": rigid_stop.grazing}


def curve(stop: float, label: str, count: int = 80, **fields: Any) -> Branch:
    """Return a curve over speed and amplitude; `fields` of the job."""
    low, high = AMPLITUDES
    values = {"from": low, "to": high, "count": count}
    second = {"parameter": "amplitude", "values": values, "labels": [label], "curves": 1}
    job = branch_job(stop, **(BRANCHES[label] | {"second": second} | fields))
    _, found = branches(run(job, processes=1).study())
    if found.of != label:
        raise SystemExit(f"no curve {label}: {found.failure}")
    return found


def apart(found: Branch) -> tuple[Floats, Floats]:
    """Return how far amplitudes are from the rigid stop's, relative, and their bounds so."""
    known = KNOWN[found.of](found.column(VALUE)).amplitude
    return found.column(SECOND) / known - 1.0, found.column(SECOND_BOUND) / known


def print_generalised(curves: list[Branch]) -> None:
    """Print where doubling turns from hard to soft, of each stiffness, and of a rigid stop."""
    points = []
    for one in (one for found in curves for one in found.special if one.label == "GPD"):
        points.append(np.array([one.value, 1e3 * (one.second or 0.0)]))
        print(f"      GPD {one.value:.5f} +- {one.bound:.0e} rad/s, {points[-1][1]:.5f} mm", end="")
        print(f": {one.note}")
    soft, hard = points
    limit, known = hard + (hard - soft) / (10.0**0.4 - 1.0), generalised_doubling()
    print(f"      in the limit {limit[0]:.5f} rad/s, {limit[1]:.5f} mm; ", end="")
    print(f"of impacts on a rigid stop {known[0]:.5f} rad/s, {1e3 * known[1]:.5f} mm")


def main() -> None:
    """Print how far each curve is from the closed form, and how that falls with the stiffness."""
    print(
        f"{'curve':6}{'K, N/m^1.5':>12}{'orbits':>8}{'speeds, rad/s':>18}{'amplitudes, mm':>18}",
        end="",
    )
    print(f"{'largest distance':>18}{'bound':>10}{'seconds':>9}")
    for label in BRANCHES:
        away, curves = [], []
        for stop in STOPS:
            begun = time.process_time()
            found = curve(stop, label)
            distance, bound = apart(found)
            speeds, amplitudes = found.column(VALUE), 1e3 * found.column(SECOND)
            print(f"{label:6}{stop:12.0e}{len(found.column(LENGTH)):8}", end="")
            for one in (speeds, amplitudes):
                print(f"{one.min():10.4f} -{one.max():8.4f}"[-18:].rjust(18), end="")
            print(f"{np.abs(distance).max():18.1e}{bound.max():10.0e}", end="")
            print(f"{time.process_time() - begun:9.1f}", flush=True)
            order = np.argsort(amplitudes)
            away.append((amplitudes[order], distance[order]))
            curves.append(found)
        shared = np.linspace(5.0, 5.5, 5)
        first, second = (np.interp(shared, *one) for one in away)
        print(
            f"      ratio of distances at 5 to 5.5 mm: {(first / second).round(3).tolist()}", end=""
        )
        print(f"; 10^0.4 is {10.0**0.4:.3f}")
        if label == "PD":
            print_generalised(curves)


if __name__ == "__main__":
    main()
