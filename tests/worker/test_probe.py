"""Cost of a job, estimated from its beginning."""

import time
from types import SimpleNamespace
from typing import cast

import pytest

from jointplay.solver.kernels.cache import SPENT
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


def test_steps_are_those_of_a_trajectory_whose_companions_are_behind(monkeypatch):
    """Those of a walking leg are half as far as it is: an estimate said twice its steps."""
    monkeypatch.setattr(probe, "BUDGET", 0.0)
    job = {"kind": "simulate", "scene": given("jansen-leg"), "duration": 6.0}
    alone = Simulation(cast("Admission", admit(job | {"certificate": False})))
    for _ in alone.slices():
        pass
    cost = probe.cost_of(admit(job).job)
    assert not cost.exact
    assert cost.steps == pytest.approx(alone.summary().statistics["steps"], rel=0.1)


def test_what_is_compiled_on_the_way_is_no_pace_of_a_job(monkeypatch):
    """A second kernel, as of tangents, was: an estimate of a job of minutes said hours."""
    late, begun, clock = [0.0], SPENT.seconds, time.process_time
    monkeypatch.setattr(time, "process_time", lambda: clock() + late[0])
    monkeypatch.setattr(SPENT, "seconds", begun)  # that it is again what it was
    mark = probe.Mark

    def marked(seconds, fraction, *reached):
        if fraction and not late[0]:  # from now on, as if it had been compiled
            late[0] = 1e6
            SPENT.seconds += 1e6
        return mark(seconds, fraction, *reached)

    monkeypatch.setattr(probe, "Mark", marked)
    job = {"kind": "simulate", "scene": given("four-bar"), "duration": 6.0}
    cost = probe.cost_of(admit(job).job)
    assert cost.compilation == pytest.approx(1e6, abs=1e3)  # and what is compiled here
    assert 0.0 < cost.seconds < 1e4


@pytest.mark.parametrize("pieces", [1000, 4])
def test_what_a_block_takes_to_begin_is_no_pace_of_its_points(monkeypatch, pieces):
    """Starts of 64 points of a four-bar took 5 s: an estimate of ten minutes said eight days."""
    begun, piece_seconds = 5.0, 0.2

    class Block:
        seconds, steps = begun, 0.0

        def slices(self):
            for nth in range(pieces):
                self.seconds, self.steps = self.seconds + piece_seconds, self.steps + 1.0
                yield SimpleNamespace(fraction=(nth + 1) / pieces, ended=[])

    monkeypatch.setattr(probe, "computation_of", lambda study, index: Block())
    study = admit(
        {
            "kind": "basin-stability",
            "scene": given("impact-oscillator"),
            "starts": {
                "/start/joints/stop/rate/0": {"distribution": "uniform", "low": 0, "high": 0.1}
            },
            "samples": 256,
        }
    )
    cost = probe._of_study(study)
    assert cost.seconds == pytest.approx(len(study.blocks) * (begun + pieces * piece_seconds))
    assert cost.steps == len(study.blocks) * pieces
