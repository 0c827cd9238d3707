"""Cost of a job, estimated from its beginning."""

from typing import cast

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import step_columns
from jointplay.solver.runs.simulate import Simulation
from jointplay.worker import probe
from tests.presets_given import given


def test_a_busy_machine_makes_no_estimate_of_a_few_steps(monkeypatch):
    monkeypatch.setattr(probe, "BUDGET", 0.0)  # it is over when the first steps are made
    job = {"kind": "simulate", "scene": given("four-bar"), "duration": 6.0}
    admission = cast("Admission", admit(job))
    cost = probe.cost_of(admission.job)
    simulation = Simulation(admission)
    for _ in simulation.slices():
        pass
    steps = simulation.summary().statistics["steps"]
    assert not cost.exact
    assert steps / 2 < cost.steps < 2 * steps
    stored = admission.stored_bytes + 8 * len(step_columns(admission)) * steps
    assert 0.25 * stored < cost.bytes < 1.5 * stored
