"""Steps end at knots of tables, and where `only` sets in: what is left of errors there.

    python -m benchmarks knots

A block between a spring, a steady force and one over its position passes the knots of a table
for 10 s; the error is that of its position at the end, against tolerance 1e-12. Behind the bar:
attempts at a step.
"""

from typing import Any

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation

DURATION = 10.0
TOLERANCES = (1e-4, 1e-6, 1e-8)
TABLE = {
    "type": "table",
    "knots": [-0.5, -0.2, 0.0, 0.1, 0.3, 0.5],
    "values": [0.0, -3.0, 2.0, -4.0, 1.0, 0.0],
    "outside": "held",
}
FORCES: dict[str, dict[str, Any]] = {
    "smooth table": {"course": TABLE | {"between": "smooth"}},
    "monotone table": {"course": TABLE | {"between": "monotone"}},
    "ramp": {"course": {"type": "ramp", "start": -2.0, "end": 2.0, "length": 0.1}},
    "only rising, in full from 1 m/s": {"only": "rising", "full_rate": 1.0},
    "only rising, in full from 1 mm/s": {"only": "rising", "full_rate": 1e-3},
}


def job(force: dict[str, Any], tolerance: float) -> dict[str, Any]:
    """Return a block between a spring, a steady force and one over its position."""
    points = {"points": {"O": [0.0, 0.0]}}
    ends = {"first": "ground.O", "second": "block.O"}
    push = {"type": "force", "magnitude": 2.0, "direction": [1.0, 0.0], "over": {"quantity": "x"}}
    steady = {"type": "force", "magnitude": 1.0, "direction": [1.0, 0.0]}
    scene = {
        "name": "block",
        "ground": points,
        "bodies": {"block": {"mass": 1.0, "inertia": 1.0} | points},
        "joints": {
            "slide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "block.O",
                "axis": [1.0, 0.0],
            }
        },
        "forces": {
            "push": push | ends | force,
            "steady": steady | ends,
            "spring": {"type": "spring-damper", "stiffness": 30.0} | ends,
        },
        "start": {"velocities": {"block": [1.0, 0.0]}},
    }
    return {"kind": "simulate", "scene": scene, "duration": DURATION, "tolerance": tolerance}


def reached(force: dict[str, Any], tolerance: float) -> tuple[float, int]:
    """Return the position of the block at the end, m, and how many steps were attempted."""
    admission = admit(job(force, tolerance))
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    *_, last = (found.samples for found in simulation.slices() if len(found.samples))
    names = [channel.name for channel in admission.channels]
    counted = simulation.summary().statistics
    return float(last[-1, names.index("block.x")]), counted["steps"] + counted["rejections"]


def main() -> None:
    """Print the errors, m."""
    print(f"{'force over position':34}" + "".join(f"{t:>17.0e}" for t in TOLERANCES))
    for name, force in FORCES.items():
        truth, _ = reached(force, 1e-12)
        found = [reached(force, tolerance) for tolerance in TOLERANCES]
        columns = [f"{abs(position - truth):10.1e} | {attempts:4}" for position, attempts in found]
        print(f"{name:34}" + "".join(columns))
