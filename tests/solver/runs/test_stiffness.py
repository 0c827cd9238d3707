"""The method that `"auto"` takes: explicit, unless its steps hardly bring the run on."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from jointplay.solver.kinds import admit
from jointplay.solver.kinds.simulate import Admission
from jointplay.solver.runs.results import Summary
from jointplay.solver.runs.simulate import Simulation

CHATTER = {"friction": 0.3, "static_velocity": 1e-7, "dynamic_velocity": 1e-6}


def job(preset: str, duration: float, values: dict[str, float], **fields: Any) -> Admission:
    scene = {"preset": preset, "parameters": values}
    document = {"kind": "simulate", "scene": scene, "duration": duration, "certificate": False}
    admission = admit(document | fields)
    assert isinstance(admission, Admission)
    return admission


def history(simulation: Simulation) -> tuple[NDArray[np.float64], Summary]:
    samples = [piece.samples for piece in simulation.slices()]
    return np.concatenate(samples), simulation.summary()


@pytest.mark.parametrize(
    ("fields", "method", "reason"),
    [
        ({}, "tsitouras", "not stiff"),
        ({"accuracy": "fine"}, "tsitouras", "not stiff"),
        ({"accuracy": "reference"}, "tsitouras", "too small for 'rodas'"),
        ({"accuracy": "draft"}, "dormand-prince-853", "asked for"),
        ({"tolerance": 1e-4}, "dormand-prince-853", "too large for 'tsitouras'"),
        ({"method": "tsitouras"}, "tsitouras", "asked for"),
    ],
)
def test_a_result_says_which_method_ran_and_why(
    fields: dict[str, Any], method: str, reason: str
) -> None:
    statistics = history(Simulation(job("seven-bar-press", 0.02, {}, **fields)))[1].statistics
    assert statistics["method"] == method
    assert reason in statistics["method_reason"]


def test_what_is_held_back_until_the_method_is_chosen_is_handed_out() -> None:
    # 3 s, of which a tenth of a period of 2 s is held back
    automatic, _ = history(Simulation(job("seven-bar-press", 3.0, {})))
    asked, _ = history(Simulation(job("seven-bar-press", 3.0, {}, method="tsitouras")))
    assert np.array_equal(automatic, asked)


def test_a_checkpoint_from_before_the_choice_begins_again() -> None:
    admission = job("slider-crank", 1e-3, CHATTER)
    simulation = Simulation(admission)
    early = next(iter(simulation.slices()))
    assert early.fraction == 0.0
    assert len(early.samples) == 0
    again = Simulation(admission, simulation.checkpoint())
    assert next(iter(again.slices())).first_sample == 0
    assert again.summary().statistics["steps"] == simulation.summary().statistics["steps"]


@pytest.mark.long
def test_friction_that_chatters_is_left_to_the_implicit_method() -> None:
    admission = job("slider-crank", 2e-2, CHATTER)
    samples, summary = history(Simulation(admission))
    statistics = summary.statistics
    assert statistics["method"] == "rodas"
    assert statistics["method_reason"].startswith("stiff: ")
    energy = statistics["energy"]
    # what every run is held to: the tolerance is the job's, not the tighter one of the method
    assert abs(energy["residual"]) <= 10.0 * admission.tolerance * energy["gross_work"]

    simulation = Simulation(admission)  # a checkpoint after the choice goes on with its method
    kept = []
    for piece in simulation.slices():
        kept.append(piece.samples)
        if piece.fraction > 0.0:
            break
    resumed = Simulation(admission, simulation.checkpoint())
    kept += [piece.samples for piece in resumed.slices()]
    assert np.array_equal(np.concatenate(kept), samples)
    assert resumed.summary().statistics["method"] == "rodas"
    assert resumed.summary().statistics["method_reason"] == statistics["method_reason"]

    certified = Simulation(job("slider-crank", 2e-2, CHATTER, certificate=True))
    assert np.array_equal(history(certified)[0], samples)
