"""Restitution that dissipation laws deliver: free impacts by the solver, at tolerance 1e-10.

A journal of 1 kg is thrown at its bearing at 0.2 m/s, on a contact of 1e9 N/m^1.5. Prints the
rows of `solver/laws/delivered.py`; what a law delivers beside the ones of `Latched` holds for the
exponent 1.5 and the mass that the contact feels.
"""

from typing import Any

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.laws.delivered import ASKED
from jointplay.solver.laws.dissipation import LAWS
from jointplay.solver.runs.simulate import Simulation

CLEARANCE, SPEED, MASS = 5e-4, 0.2, 1.0


def delivered(law: str, asked: float) -> float:
    """Return the share of its speed that the journal gets back."""
    dissipation: dict[str, Any] = {"law": law, "restitution": asked}
    if "effective_mass" in LAWS[law].model_fields:
        dissipation["effective_mass"] = MASS
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": 1e9},
        "dissipation": dissipation,
    }
    point = {"points": {"O": [0.0, 0.0]}}
    play = {"radial_clearance": CLEARANCE, "bearing_radius": 0.01, "contact": contact}
    bearing = {"type": "revolute", "bearing": "ground.O", "journal": "journal.O", "clearance": play}
    scene = {
        "name": "thrown-journal",
        "ground": point,
        "bodies": {"journal": {"mass": MASS, "inertia": 1.0} | point},
        "joints": {"bearing": bearing},
        "start": {"velocities": {"journal": [SPEED, 0.0]}},
    }
    job = {"kind": "simulate", "scene": scene, "duration": 2.9 * CLEARANCE / SPEED}
    admission = admit(job | {"tolerance": 1e-10, "certificate": False})
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    for _ in simulation.slices():
        pass
    return -simulation.summary().peaks["journal.vx"].minimum / SPEED


def main() -> None:
    """Print a row for each law that is asked for a restitution."""
    for name, law in LAWS.items():
        if "restitution" in law.model_fields:
            row = ", ".join(f"{delivered(name, asked):.4f}" for asked in ASKED)
            print(f'    "{name}": ({row}),')
