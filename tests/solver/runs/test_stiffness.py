"""The method that `"auto"` takes: explicit, but implicit while the run is stiff."""

import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.simulate import Admission
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.results import Summary
from jointplay.solver.runs.run_kernel import run_kernel
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.stiff_method import EARLIER, MOST_REASONS, with_reason
from jointplay.solver.runs.stiffness import fastest_rate
from jointplay.solver.scene import presets
from tests.solver.held_part import CREEP, FRICTION, PUSH, held_part

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


def test_a_run_that_is_not_stiff_has_the_bits_of_the_explicit_method() -> None:
    automatic, _ = history(Simulation(job("seven-bar-press", 3.0, {})))
    asked, _ = history(Simulation(job("seven-bar-press", 3.0, {}, method="tsitouras")))
    assert np.array_equal(automatic, asked)


def rate_in_contact(tolerance: float) -> float:
    """Return the fastest rate of a rod that starts pressed against its bearing, 1/s."""
    scene = presets.document("slider-crank") | {"parameters": {}}
    scene["joints"]["P"]["clearance"]["radial_clearance"] = 1e-8
    scene["start"] = {"joints": {"P": {"eccentricity": [2e-8, 0.0]}}}
    document = {"kind": "simulate", "scene": scene, "duration": 1.0, "tolerance": tolerance}
    admission = admit(document)
    assert isinstance(admission, Admission)
    problem = LaneProblem(admission.scene, 1.0, tolerance, 1.0, 0, 0, 0.0)
    return fastest_rate(Bundle(run_kernel(admission, "tsitouras"), [problem]), 0)


def test_the_fastest_rate_is_known_where_errors_are_below_the_rounding_of_states() -> None:
    """At 1e-10 the rod may be 1e-18 m off its position, 0.1 m from the origin: it was 0 there."""
    known = rate_in_contact(1e-6)
    # a step is 256 roundings, so that differences of two are known to 1/128
    assert rate_in_contact(1e-10) == pytest.approx(known, rel=1 / 128)
    assert known > 0.0


def held(duration: float, speed: float = 0.0, **fields: Any) -> Simulation:
    document = {"kind": "simulate", "scene": held_part(speed), "duration": duration}
    admission = admit(document | {"certificate": False} | fields)
    assert isinstance(admission, Admission)
    return Simulation(admission)


def test_a_part_that_friction_holds_without_a_period_is_left_to_the_implicit_method() -> None:
    simulation = held(2.0)
    samples, summary = history(simulation)
    statistics = summary.statistics
    # the explicit method attempts 189 837 steps, as long as is stable
    assert statistics["steps"] < 15_000
    assert statistics["method"] == "rodas"
    assert statistics["method_reason"].startswith("stiff from 0.1")
    # the approach to the creep, integrated by the implicit method alone at 1e-9
    y = [channel.name for channel in simulation.admission.channels].index("part.y")
    assert samples[-1, y] == pytest.approx(-1.054608726848e-4, abs=1e-13)
    assert (samples[-1, y] - samples[-1001, y]) == pytest.approx(-CREEP, rel=1e-6)
    energy = statistics["energy"]
    assert abs(energy["residual"]) <= 1e-6 * energy["gross_work"]
    assert summary.peaks["part.y"].minimum == samples[-1, y]
    # the guide is full of friction from the start on: what was seen before the change counts
    assert summary.peaks["pad.corner_2.normal_force"].maximum == pytest.approx(6.091674, abs=1e-6)


def test_stiffness_that_appears_later_changes_the_method_there() -> None:
    simulation = held(3.0, speed=3.0)
    samples, summary = history(simulation)
    assert summary.statistics["steps"] < 15_000  # 283 408 by the explicit method alone
    y = [channel.name for channel in simulation.admission.channels].index("part.y")
    # thrown upwards it stops after v^2 / 2a, a of its weight and of friction, and then creeps
    stops = 3.0**2 / 2.0 / (9.81 + FRICTION * PUSH / 0.045)
    assert samples[:, y].max() == pytest.approx(stops, rel=1e-3)
    assert (samples[-1, y] - samples[-667, y]) == pytest.approx(-CREEP * 0.999, rel=1e-5)


def test_a_run_that_changes_its_method_has_the_same_bits_in_pieces_and_certified() -> None:
    whole, summary = history(held(0.5))
    assert summary.statistics["method"] == "rodas"
    kept, checkpoint = [], None
    admission = held(0.5).admission
    while True:
        simulation = Simulation(admission, checkpoint)
        piece = next(iter(simulation.slices()), None)
        if piece is None:
            break
        kept.append(piece.samples)
        checkpoint = simulation.checkpoint()
    assert len(kept) > 4
    assert np.array_equal(np.concatenate(kept), whole)
    again = simulation.summary()
    assert again.peaks == summary.peaks
    seconds = {"solver_seconds": 0.0}
    assert again.statistics | seconds == summary.statistics | seconds

    certified = held(0.5, certificate=True)
    assert np.array_equal(history(certified)[0], whole)
    certificate = certified.certificate()
    assert certificate is not None
    assert certificate.facts["lanes"][7]["steps"] == summary.statistics["steps"]  # the twin


def test_a_run_out_of_time_says_when_and_where_it_was() -> None:
    with pytest.raises(SimulationFailed) as failed:
        for _ in held(2.0).slices(most_seconds=0.0):
            pass
    assert failed.value.time > 0.0
    sentence = failed.value.detail
    assert re.match(r"t = 0\.0\d+ s was reached", sentence)
    assert "steps of 'tsitouras', the last " in sentence
    assert "with in contact: pad.corner_1, pad.corner_2. Ask for" in sentence
    assert "static_velocity" in sentence


@pytest.mark.long
def test_a_press_that_strong_friction_stops_comes_to_its_end() -> None:
    values = {"speed": 300.0, "speed_crank4": 0.3, "friction": 10.0}
    admission = job("seven-bar-press", 2e-3, values)
    statistics = history(Simulation(admission))[1].statistics
    assert statistics["steps"] < 20_000  # the explicit method makes 521 543 for a quarter of it
    energy = statistics["energy"]
    assert abs(energy["residual"]) <= 10.0 * admission.tolerance * energy["gross_work"]


@pytest.mark.long
def test_friction_that_chatters_is_left_to_the_implicit_method() -> None:
    admission = job("slider-crank", 2e-2, CHATTER)
    samples, summary = history(Simulation(admission))
    statistics = summary.statistics
    assert statistics["steps"] < 100_000  # the explicit method makes millions
    changes = statistics["method_reason"].split("; ")
    # it chatters from 0.27 ms on, and how often the method changes depends on its last bits
    assert 2 <= len(changes) <= MOST_REASONS
    assert any(change.startswith("stiff from 0.0") for change in changes)
    energy = statistics["energy"]
    # what every run is held to: the tolerance is the job's, not the tighter one of the method
    assert abs(energy["residual"]) <= 10.0 * admission.tolerance * energy["gross_work"]
    # where it no longer chatters, the explicit method is faster
    assert statistics["method"] == "tsitouras"
    assert changes[-1].startswith("not stiff from ")

    certified = Simulation(job("slider-crank", 2e-2, CHATTER, certificate=True))
    assert np.array_equal(history(certified)[0], samples)


def test_the_last_changes_of_the_method_are_told_one_by_one() -> None:
    reason = "not stiff"
    for k in range(MOST_REASONS + 2):
        reason = with_reason(reason, f"change {k}")
    told = [f"change {k}" for k in range(3, MOST_REASONS + 2)]
    assert reason.split("; ") == [EARLIER, *told]
