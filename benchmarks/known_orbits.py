"""Orbits that are known: a driven pendulum, COCO's impact oscillator, one with dry friction.

The pendulum is that of Taylor 2005, Classical Mechanics, 12.4; its doublings were computed by
Newton's method with tangents, independently. The oscillator is of COCO's demo `impact`, in closed
form for a rigid stop; its numbers here are extrapolated as in `continuation`. Dry friction is that
of Den Hartog 1931, Trans. ASME 53:107, whose steady motion without stops is known in closed form;
here it turns over within a ramp, whose width is extrapolated to zero.
"""

import math
import time
from typing import Any

import numpy as np

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from benchmarks.continuation import STIFFNESSES, scene, to_the_limit
from jointplay.local import run
from jointplay.records.branch import Branch, branches

DRIVEN = 2.0 * math.pi
NATURAL = 1.5 * DRIVEN
DOUBLINGS = (1.0663728625, 1.0793139, 1.0820844, 1.0826784)
RUBS, FASTEST = 0.2, 2.9
"""N of friction, and m/s that the motion does not reach."""
RAMPS = 1.6e-3, 8e-4, 4e-4, 2e-4
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


def with_dry_friction(ratio: float, ramp: float) -> dict[str, Any]:
    """Return x'' + x + 0.2 sgn x' = cos(ratio t); friction turns over within +-ramp, m/s."""
    rubbing = {"type": "force", **ON_THE_MASS, "magnitude": RUBS, "direction": [1.0, 0.0]}
    rubbing |= {"over": {"quantity": "x", "rate": True}}
    knots = [-FASTEST, -ramp, ramp, FASTEST]
    course = {"type": "table", "knots": knots, "values": [1.0, 1.0, -1.0, -1.0], "outside": "held"}
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": 1.0}
    forces = {"spring": spring, "rubbing": rubbing | {"course": course}}
    written = sliding("dry-friction", 1e-13, **forces, drive=shaking(1.0, ratio))
    drive = {"help": "Force.", "unit": "N", "default": 1.0}
    return written | {
        "parameters": {"drive": drive | {"targets": [{"path": "/forces/drive/magnitude"}]}}
    }


def den_hartog(ratio: float) -> tuple[float, float, float]:
    """Return amplitude, position and speed (m, m/s) where the force is largest, of sliding motion.

    From a turning point on, x = f + V cos(r t + phase) + B cos t + C sin t, until it is at the
    other one after half a period.
    """
    half = math.pi / ratio
    cosine, sine, response = math.cos(half), math.sin(half), 1.0 / (1.0 - ratio * ratio)
    rest = sine / (ratio * (1.0 + cosine))
    amplitude = math.sqrt(response**2 - (rest * RUBS) ** 2)
    c = -2.0 * RUBS / ((1.0 + cosine) ** 2 / sine + sine)
    b = c * (1.0 + cosine) / sine
    phase = math.atan2(c / (ratio * response), (amplitude - RUBS - b) / response)
    at = -phase / ratio
    halves = math.floor(at / half)
    t, sign = at - halves * half, (-1.0) ** halves
    turned = ratio * t + phase
    position = RUBS + response * math.cos(turned) + b * math.cos(t) + c * math.sin(t)
    speed = -ratio * response * math.sin(turned) - b * math.sin(t) + c * math.cos(t)
    return amplitude, sign * position, sign * speed


def dry_friction() -> float:
    """Print sections beside Den Hartog's; return the largest distance."""
    worst = 0.0
    for ratio in (1.25, 1.5):
        amplitude, *known = den_hartog(ratio)
        rows = []
        for ramp in RAMPS:
            values = {"from": 1.0, "to": 1.01, "count": 2}
            job = {"scene": with_dry_friction(ratio, ramp), "parameter": "drive", "settle": 200}
            (branch,) = followed(job | {"values": values, "tolerance": 1e-12})
            rows.append([float(branch.column(f"{name}.mass.s")[0]) for name in ("state", "rate")])
        powers = np.vander(np.array(RAMPS), len(RAMPS), increasing=True)
        apart = np.linalg.solve(powers, np.array(rows))[0] - known
        print(f"dry friction, r {ratio}: amplitude {amplitude:.10f}", end="")
        print(f"  section apart {apart[0]:.0e} m, {apart[1]:.0e} m/s")
        worst = max(worst, float(np.abs(apart).max()))
    return worst


def main() -> None:
    """Print all tables."""
    begun = time.process_time()
    dry_friction()
    print(f"{time.process_time() - begun:.1f} s of one core")
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
