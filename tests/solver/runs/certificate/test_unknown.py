"""Certificates of motions that are not known at the first instant at which they are compared."""

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation


def test_a_horizon_of_zero_says_when_companions_were_compared_first() -> None:
    scene = {"preset": "seven-bar-press", "parameters": {"clearance": 1e-4, "stiffness": 1e12}}
    job = {"kind": "simulate", "scene": scene, "duration": 2.0, "output_step": 2.0}
    admission = admit({**job, "certificate": True})
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    assert list(simulation.slices())
    facts = simulation.certificate().facts
    # the first impacts, a few milliseconds from the start, lie before the first instant
    assert facts["horizon"] == 0.0
    assert "compared first at 0.0156 s" in facts["note"]
    assert facts["exponent"] is not None
    assert "windows" in facts["exponent_note"]
