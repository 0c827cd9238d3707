"""Branches of the impact oscillator over the stiffness of its stop, beside Newton's law of impact.

A hard stop that takes a share of the speed is Newton's law in the limit, where folds, doublings and
multipliers are known in closed form. Contact takes a time that falls as K^-0.4: numbers of four
stiffnesses are a polynomial of that, and its value at zero is compared.
"""

import json
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from benchmarks.rigid_stop import DAMPING, GAP, STIFFNESS
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch, branches
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study

STIFFNESSES = (1e9, 1e10, 1e11, 1e12)
"""N/m^1.5."""
SHORTER = -0.4
AMPLITUDE = 5e-3
"""Length of the crank, m."""
RIGID = {
    "fold, rad/s": 31.4314262200,
    "doubling, rad/s": 19.2111372427,
    "grazing, rad/s": 24.3714871390,
    "at 25 rad/s, stable multiplier, real": 0.06918,
    "at 25 rad/s, stable multiplier, imaginary": 0.61836,
    "at 25 rad/s, saddle's larger multiplier": 17.09934,
    "at 25 rad/s, saddle's smaller multiplier": 0.02264,
}


def scene(stop: float) -> dict[str, Any]:
    """Return the oscillator with a stop that takes a fifth of the speed."""
    study = admit({"kind": "poincare", "scene": {"preset": "impact-oscillator"}, "settle": 0})
    assert isinstance(study, Study)
    found: dict[str, Any] = json.loads(study.point_scene(0).model_dump_json(exclude_none=True))
    found["joints"]["stop"]["clearance"]["contact"] = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": stop, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": 0.8},
    }
    for name in ("stop_stiffness", "restitution"):
        del found["parameters"][name]
    return found


def branch_job(stop: float, **fields: Any) -> dict[str, Any]:
    """Return the job of a branch over speed."""
    return {"kind": "continuation", "scene": scene(stop), "parameter": "speed", **fields}


def free_section(speed: float) -> list[float]:
    """Return the section of the motion without impacts, from the stop: m and m/s."""
    shaken = STIFFNESS * AMPLITUDE
    motion = shaken / complex(STIFFNESS - speed**2, DAMPING * speed)
    return [motion.real - GAP, -speed * motion.imag]


def branch(stop: float, **fields: Any) -> Branch:
    """Return a branch over speed; `fields` of the job."""
    return next(branches(run(branch_job(stop, **fields), processes=1).study()))


def numbers(stop: float) -> list[float]:
    """Return the numbers of `RIGID` for a stop."""
    up = branch(stop, values={"from": 25.0, "to": 33.0, "count": 200})
    down = branch(stop, values={"from": 25.0, "to": 18.0, "count": 40})
    # without impacts down to grazing, and back as a saddle to where the range begins
    values = {"from": 25.0, "to": 24.0, "count": 100}
    touching = branch(stop, values=values, at=24.5, state=free_section(24.5), settle=0)
    fold, doubling, grazing = (
        next(one for one in found.special if one.label == label)
        for found, label in ((up, "LP"), (down, "PD"), (touching, "GR"))
    )
    first = [float(up.column(f"multiplier_1.{part}")[0]) for part in ("real", "imaginary")]
    saddle = next(one.row for one in touching.special[2:] if one.label == "EP")
    pair = [float(touching.column(f"multiplier_{k}.real")[saddle]) for k in (1, 2)]
    return [fold.value, doubling.value, grazing.value, *first, *pair]


def to_the_limit(stops: Sequence[float], rows: Sequence[Sequence[float]]) -> tuple[Floats, Floats]:
    """Return numbers of each stop as (stops, numbers), and those in the limit."""
    table = np.array(rows)
    short = np.array(stops) ** SHORTER / stops[0] ** SHORTER
    return table, np.linalg.solve(np.vander(short, len(stops), increasing=True), table)[0]


def extrapolated(stops: Sequence[float]) -> tuple[Floats, Floats]:
    """Return the numbers of each stop, (stops, numbers), and those in the limit."""
    return to_the_limit(stops, [numbers(stop) for stop in stops])


def main() -> None:
    """Print the numbers of each stiffness, their limit, and Newton's law."""
    begun = time.process_time()
    table, limit = extrapolated(STIFFNESSES)
    print(f"{'K, N/m^1.5':42}" + "".join(f"{stop:12.0e}" for stop in STIFFNESSES), end="")
    print(f"{'limit':>14}{'closed form':>14}{'apart':>10}")
    for name, row, found, known in zip(RIGID, table.T, limit, RIGID.values(), strict=True):
        print(f"{name:42}" + "".join(f"{one:12.6f}" for one in row), end="")
        print(f"{found:14.7f}{known:14.7f}{found - known:10.1e}")
    print(f"{time.process_time() - begun:.1f} s of one core")


if __name__ == "__main__":
    main()
