"""Seconds of a branch: an orbit with its multipliers and errors, and a located doubling or fold.

Beside it are as many points of a bifurcation diagram over the same range. Processor time of one
core, kernels compiled before. The chain is like what COCO's published runs follow, a smooth system
of four states over the frequency that shakes it; see docs/measurements/speed.md.
"""

import argparse
import statistics
import time
from typing import Any, NamedTuple

from benchmarks.branches import CASES
from benchmarks.continuation import scene as impact_oscillator
from benchmarks.known_orbits import pendulum
from jointplay.local import run
from jointplay.records.branch import LABEL
from jointplay.solver.computations import computation_of
from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.continuation.run import section_map
from jointplay.solver.kinds import admit

SETTLE, RECORD = 100, 50
"""Periods of a point of the diagram."""


class Cost(NamedTuple):
    """Processor time of the parts of a branch, s."""

    orbits: list[float]
    """Time of each orbit without a special one before it."""
    located: list[tuple[str, float]]
    """Label and time of each special orbit."""
    whole: float


def chain() -> dict[str, Any]:
    """Return two masses on springs, one of them cubic, the second one shaken."""
    masses = {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}}
    slide = {"type": "prismatic", "guide": "ground.O", "axis": [1.0, 0.0]}
    ends = {"first": "ground.O", "second": "one.centre"}
    between = {"first": "one.centre", "second": "two.centre"}
    spring = {"type": "spring-damper", "stiffness": 1.0, "damping": 0.1}
    along = {"type": "force", "direction": [1.0, 0.0]}
    cubic = {"type": "polynomial", "coefficients": [0.0, 0.0, 0.0, -0.5]}
    wave = {"type": "sinusoidal", "amplitude": 0.08, "frequency": 0.5}
    targets = [{"path": "/forces/shaking/course/frequency"}]
    return {
        "name": "chain",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"one": masses, "two": masses},
        "joints": {name: slide | {"slider": f"{name}.centre"} for name in ("one", "two")},
        "forces": {
            "first": spring | ends,
            "second": spring | between,
            "cubic": along | ends | {"magnitude": 1.0, "over": {"quantity": "x"}, "course": cubic},
            "shaking": along
            | {"first": "ground.O", "second": "two.centre", "magnitude": 1.0, "course": wave},
        },
        "parameters": {
            "frequency": {"help": "Frequency.", "unit": "rad/s", "default": 0.5, "targets": targets}
        },
    }


def of_branch(name: str) -> dict[str, Any]:
    """Return scene, parameter, values and what else the job of a case of `branches` has."""
    preset, parameters, fields = CASES[name]
    return {"scene": {"preset": preset, "parameters": parameters}} | fields


JOBS: dict[str, dict[str, Any]] = {
    "chain": {
        "scene": chain(),
        "parameter": "frequency",
        "values": {"from": 0.45, "to": 1.8, "count": 250},
        "largest_step": 0.1,
    },
    "pendulum": {
        "scene": pendulum(),
        "parameter": "strength",
        "values": {"from": 1.06, "to": 1.07, "count": 30},
    },
    "impact-oscillator": {
        "scene": impact_oscillator(1e11),
        "parameter": "speed",
        "values": {"from": 25.0, "to": 18.0, "count": 40},
    },
    "slider-crank": of_branch("slider-crank-speed"),
}


def cost(job: dict[str, Any]) -> Cost:
    """Return what a branch costs."""
    study = admit({"kind": "continuation"} | job)
    assert isinstance(study, ContinuationStudy)
    section_map(study)  # compiles
    at = [channel.name for channel in study.observables].index(LABEL)
    begun = before = time.process_time()
    begins, orbits, located = True, list[float](), list[tuple[str, float]]()
    special = ""
    for one in computation_of(study, 0).slices():
        for rows in one.rows:
            now = time.process_time()
            label = list(LABELS)[int(rows.values[0, at])]
            if begins:
                begins = False
            elif label not in ("", "EP", "MX"):
                special = f"{special} {label}".strip()
                continue
            elif special:
                located.append((special, now - before))
                special = ""
            else:
                orbits.append(now - before)
            before = now
    typical = statistics.median(orbits)
    beyond = [(label, seconds - typical) for label, seconds in located]
    return Cost(orbits, beyond, time.process_time() - begun)


def of_diagram(job: dict[str, Any], points: int) -> float:
    """Return the processor time of a point of a diagram over the same range, s."""
    values = job["values"] | {"count": points}
    fields = {"kind": "bifurcation", "scene": job["scene"], "parameter": job["parameter"]}
    fields |= {"values": values, "settle": SETTLE, "record": RECORD}
    run(fields | {"values": values | {"count": 2}}, processes=1)  # compiles
    begun = time.process_time()
    run(fields, processes=1)
    return (time.process_time() - begun) / points


def main() -> None:
    """Print a line for each case, and one for each special orbit."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks continuation_cost", description=__doc__
    )
    parser.add_argument("--only", choices=JOBS, nargs="+", default=list(JOBS))
    for name in parser.parse_args().only:
        found = cost(JOBS[name])
        count, typical = len(found.orbits), statistics.median(found.orbits)
        point = of_diagram(JOBS[name], count)
        print(
            f"{name:18}{count:4} orbits, {typical:.3f} s each, branch {found.whole:.1f} s;", end=""
        )
        print(f" a point of a diagram {point:.4f} s, {typical / point:.1f} an orbit", flush=True)
        for label, seconds in found.located:
            print(f"{label:>22} located in {seconds:.2f} s, {seconds / typical:.1f} orbits")


if __name__ == "__main__":
    main()
