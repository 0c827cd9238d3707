"""Branches whose special orbits are known: a damped driven pendulum, COCO's impact oscillator.

The pendulum is that of Taylor 2005, Classical Mechanics, 12.4; its doublings were computed by
Newton's method with tangents, independently. The oscillator is of COCO's demo `impact`, in closed
form for a rigid stop; its numbers here are extrapolated as in `continuation`.
"""

import math
import time
from typing import Any

import numpy as np

from benchmarks.continuation import STIFFNESSES, scene, to_the_limit
from jointplay.local import run
from jointplay.records.branch import Branch, branches

DRIVEN = 2.0 * math.pi
NATURAL = 1.5 * DRIVEN
DOUBLINGS = (1.0663728625, 1.0793139, 1.0820844, 1.0826784)
TENTH = 0.1
"""m, of a unit of length of the demo; so its unit of force is."""
IMPACTS = {
    "A 1: product of multipliers / (e^2 exp(-c T))": 1.0,
    "A 1: multipliers, real": -0.584295,
    "A 1: multipliers, imaginary": 0.005600,
    "fold next to grazing, A": 0.0999707536,
}


def pendulum() -> dict[str, Any]:
    """Return a rod driven by a moment: angle'' + 2 b angle' + w0^2 sin = strength w0^2 cos(wt)."""
    square = NATURAL * NATURAL
    wave = {"type": "sinusoidal", "amplitude": 1.0, "frequency": DRIVEN, "phase": math.pi / 2.0}
    return {
        "name": "pendulum",
        "gravity": [0.0, -2.0 * square],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rod": {"mass": 1.0, "inertia": 0.75, "points": {"O": [-0.5, 0.0]}}},
        "joints": {"O": {"type": "revolute", "bearing": "ground.O", "journal": "rod.O"}},
        "forces": {
            "drive": {
                "type": "torque",
                "first": "ground.O",
                "second": "rod.O",
                "moment": square,
                "course": wave,
            },
            "damper": {
                "type": "torsion-spring",
                "first": "ground.O",
                "second": "rod.O",
                "damping": NATURAL / 2.0,
            },
        },
        "start": {"angles": {"rod": -math.pi}},
        "parameters": {
            "strength": {
                "help": "Strength of the drive.",
                "unit": "1",
                "default": 1.0,
                "targets": [{"path": "/forces/drive/moment", "factor": square}],
            }
        },
    }


def followed(job: dict[str, Any]) -> list[Branch]:
    """Return the branches of a job."""
    found = list(branches(run({"kind": "continuation"} | job, processes=1).study()))
    for one in found:
        if one.failure:
            raise SystemExit(one.failure.detail)
    return found


def doublings() -> list[float]:
    """Print each doubling of the pendulum beside the known one; return how far they are apart."""
    job = {
        "scene": pendulum(),
        "parameter": "strength",
        "values": {"from": 1.06, "to": 1.084, "count": 60},
        "settle": 300,
        "doublings": 3,
        "tolerance": 1e-12,
    }
    found = [next(s for s in one.special if s.label == "PD") for one in followed(job)]
    for one, known in zip(found, DOUBLINGS, strict=True):
        print(f"doubling {one.value:.11f} +- {one.bound:.0e}  known {known:<12}", end="")
        print(f"  apart {one.value - known:.0e}")
    gaps = np.diff([one.value for one in found])
    print("ratios of intervals", (gaps[:-1] / gaps[1:]).tolist())
    return [one.value - known for one, known in zip(found, DOUBLINGS, strict=True)]


def impacts(stop: float) -> list[float]:
    """Return the numbers of `IMPACTS` for a stiffness of the stop."""
    written = scene(stop)
    units = {"stiffness": 1.0, "damping": 0.1, "gap": TENTH, "speed": 1.0, "amplitude": TENTH}
    for name, value in units.items():
        written["parameters"][name]["default"] = value
    values = {"from": TENTH, "to": 0.099 * TENTH, "count": 400}
    job = {"scene": written, "parameter": "amplitude", "values": values, "settle": 200}
    (branch,) = followed(job)
    pair = [float(branch.column(f"multiplier_1.{part}")[0]) for part in ("real", "imaginary")]
    share = math.hypot(*pair) ** 2 / (0.64 * math.exp(-0.1 * 2.0 * math.pi))
    for one in branch.special:
        print(f"    {one.label} {one.value / TENTH:.10f} {one.note}")
    fold = next(one.value for one in branch.special if one.label == "LP")
    return [share, *pair, fold / TENTH]


def main() -> None:
    """Print both tables."""
    begun = time.process_time()
    doublings()
    print(f"{time.process_time() - begun:.1f} s of one core")
    begun = time.process_time()
    table, limit = to_the_limit(STIFFNESSES, [impacts(stop) for stop in STIFFNESSES])
    for name, row, found, known in zip(IMPACTS, table.T, limit, IMPACTS.values(), strict=True):
        print(f"{name:46}" + "".join(f"{one:12.6f}" for one in row), end="")
        print(f"{found:14.7f}{known:14.7f}{found - known:10.1e}")
    print(f"{time.process_time() - begun:.1f} s of one core")


if __name__ == "__main__":
    main()
