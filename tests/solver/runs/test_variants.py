"""Runs of the press and the others with every kind of parameter: they end, and end alike."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import admit
from jointplay.solver.runs.results import Slice
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets
from tests.presets_given import REQUIRED, compiled
from tests.solver.completed_runs import CASE_3, Run, run
from tests.solver.moved_scenes import mirrored, translated
from tests.solver.readable_mechanics import at_start, preset

END = 0.1


def press(duration: float = END, tolerance: float = 1e-8, **parameters: Any) -> Run:
    return run(
        "seven-bar-press",
        duration,
        parameters={**CASE_3, **parameters},
        tolerance=tolerance,
        output_step=duration / 100,
    )


def assert_sound(found: Run) -> None:
    for name, values in found.samples.items():
        assert np.isfinite(values).all(), name
    for joint in found.admission.joints:
        assert found.peaks[f"{joint}.penetration"].maximum < 1e-3
    assert found.statistics["onsets"] >= 1


@pytest.mark.parametrize(
    "parameters",
    [
        {"speed": -math.pi},
        {"speed": 10.0, "speed_crank4": 10.0},
        # friction that jumps: before the first impact it chatters, in 800 000 steps
        pytest.param({"static_velocity": 1e-3, "dynamic_velocity": 1e-3}, marks=pytest.mark.long),
        {"static_velocity": 0.1, "dynamic_velocity": 0.1},
        {"static_velocity": 0.0, "dynamic_velocity": 1e-2},
        {"gravity_x": 0.0},
        {"gravity_x": -9.81},
        {"gravity_x": 0.0, "gravity_y": -9.81},
        {"restitution": 0.0},
        {"restitution": 1.0},
        {"impact_rate_floor": 0.1},
        {"clearance_A": 1e-6, "clearance_B": 1e-3},
        {"friction": 1.0},
        {"speed": 100.0},
        {"speed": 0.0},
    ],
    ids=str,
)
def test_the_press_runs_with_any_numbers(parameters: dict[str, float]) -> None:
    assert_sound(press(**parameters))


@pytest.mark.parametrize(
    "parameters",
    [
        {"friction": 0.0},
        {"friction": 0.0, "exponent": 1.2, "stiffness": 1e8},
        {"gravity_y": 0.0, "velocity_x": 0.5},
    ],
    ids=str,
)
def test_the_bouncing_journal_runs_in_any_structure(parameters: dict[str, float]) -> None:
    found = run("bouncing-journal", 0.1, parameters=parameters, tolerance=1e-8)
    for name, values in found.samples.items():
        assert np.isfinite(values).all(), name
    assert found.statistics["onsets"] >= 2


def test_a_small_exponent_other_than_the_hertz_one_tends_to_it() -> None:
    # the general power and x sqrt(x) are two ways to the same force
    hertz, general = (
        run(
            "bouncing-journal",
            0.05,
            parameters={"friction": 0.0, "exponent": exponent},
            tolerance=1e-10,
            output_step=0.001,
        )
        for exponent in (1.5, 1.5 * (1.0 + 1e-12))
    )
    # a relative change of the exponent by 1e-12 changes forces by 1e-11: ln(depth) is about -10
    np.testing.assert_allclose(general["height"], hertz["height"], rtol=0, atol=1e-9)


# drivers


@pytest.mark.parametrize(
    ("speed", "speed_crank4", "period"),
    [
        (math.pi, -math.pi, 2.0),
        (-math.pi, math.pi, 2.0),
        (4.0, 2.0, math.pi),
        (2.0, -4.0, math.pi),
        (6.0, 4.0, math.pi),
        (3.0, 0.0, 2.0 * math.pi / 3.0),
        (0.1, 0.3, 20.0 * math.pi),
    ],
)
def test_the_period_is_the_least_common_one(
    speed: float, speed_crank4: float, period: float
) -> None:
    found = press(duration=1e-3, speed=speed, speed_crank4=speed_crank4)
    assert found.admission.period == pytest.approx(period, rel=1e-14)
    assert found.admission.section_note == ""
    assert found.admission.sections == 1


@pytest.mark.parametrize(
    ("speed", "speed_crank4"), [(1.0, math.sqrt(2.0)), (math.pi, 3.0), (0.0, 0.0)]
)
def test_without_a_common_period_there_is_no_section_and_a_reason(
    speed: float, speed_crank4: float
) -> None:
    found = press(duration=0.01, speed=speed, speed_crank4=speed_crank4)
    assert found.admission.period is None
    assert found.admission.sections == len(found.section_time) == 0
    assert "no Poincare section" in found.admission.section_note


def test_incommensurate_cranks_keep_their_angles_over_many_turns() -> None:
    speeds = (40.0, 40.0 * math.sqrt(2.0))
    found = press(duration=2.0, tolerance=1e-6, speed=speeds[0], speed_crank4=speeds[1])
    # angles of 80 rad and more, to their rounding
    np.testing.assert_allclose(found["crank1.theta"], speeds[0] * found.time, rtol=1e-14)
    start = at_start(preset("seven-bar-press")).driven["drive4"]
    np.testing.assert_allclose(
        found["crank4.theta"], start + speeds[1] * found.time, rtol=0, atol=1e-13
    )


def test_two_to_one_cranks_repeat_their_angles_at_sections() -> None:
    found = press(duration=2.0, tolerance=1e-6, speed=10.0, speed_crank4=-20.0)
    assert len(found.section_time) == 4
    np.testing.assert_allclose(found.section_time, 0.2 * math.pi * np.arange(4), rtol=1e-15)
    np.testing.assert_allclose(
        found.sections["crank1.theta"], 2.0 * math.pi * np.arange(4), rtol=1e-15
    )
    # positions repeat to the rounding of lengths below 1 m
    assert np.ptp(found.sections["crank4.x"]) < 1e-15


# symmetries of whole runs


def test_a_translated_journal_moves_alike() -> None:
    parameters = {"velocity_x": 0.15, "spin": 20.0}
    scene = translated(preset("bouncing-journal", **parameters), (3.0, -2.0)).model_dump()
    scene["parameters"] = {}
    here = run("bouncing-journal", 0.05, parameters=parameters, tolerance=1e-9)
    there = run(scene, 0.05, tolerance=1e-9)
    # an onset is located to 1e-13 m, within which coordinates of 3 m, of rounding 4e-16 m, may land
    # elsewhere; a bounce on the round wall multiplies that by up to five, and there are four
    for channel, shift, tolerance in (
        ("journal.x", 3.0, 1e-8),
        ("journal.y", -2.0, 1e-8),
        ("journal.theta", 0.0, 1e-6),
        ("bearing.eccentricity_x", 0.0, 1e-8),
    ):
        np.testing.assert_allclose(there[channel], here[channel] + shift, rtol=0, atol=tolerance)
    # scales of the error norm do not see the distance from the origin, which is 3000 clearances:
    # the same steps are made but for the few whose acceptance hangs on rounding
    assert there.statistics["steps"] == pytest.approx(here.statistics["steps"], rel=0.05)
    assert there.statistics["onsets"] == here.statistics["onsets"] >= 4


def test_a_mirrored_press_runs_as_the_mirror_image() -> None:
    scene = mirrored(at_start(preset("seven-bar-press", **CASE_3))).scene.model_dump()
    scene["parameters"] = {}
    here = press(duration=0.03, tolerance=1e-10)
    there = run(scene, 0.03, tolerance=1e-10, output_step=0.03 / 100)
    for name, sense in (("x", 1.0), ("y", -1.0), ("theta", -1.0), ("vx", 1.0), ("omega", -1.0)):
        for body in ("link2", "link3", "link6"):
            rates = 1e4 if name in ("vx", "omega") else 1.0  # impacts last 0.1 ms
            np.testing.assert_allclose(
                there[f"{body}.{name}"],
                sense * here[f"{body}.{name}"],
                rtol=0,
                # rounding, 1e-15, amplified by three impacts about a hundredfold each
                atol=1e-9 * rates,
            )


@pytest.mark.parametrize("name", compiled())
def test_both_formulations_give_the_same_run_across_periods_and_their_ledgers_close(
    name: str,
) -> None:
    duration = {
        "seven-bar-press": 0.05,
        "seven-bar-press-fitted": 0.05,
        "seven-bar-press-punching": 0.05,
        "slider-crank": 0.003,
        "bouncing-journal": 0.03,
        "pendulum": 3.0,
        "andrews-squeezer": 0.01,
        "double-four-bar": 1.0,
        "quick-return": 0.05,
        "jansen-leg": 0.05,
        "seven-bar-test-bed": 0.05,
        "four-bar": 0.02,
        "n-four-bar": 0.5,
        "double-pendulum": 1.0,
        "driven-pendulum": 3.0,
        "impact-oscillator": 0.5,
    }[name]
    parameters = REQUIRED.get(name, {})
    if name.startswith("seven-bar-press"):
        parameters = {**CASE_3, "speed": 150.0}  # more than one period within the horizon
    if name == "seven-bar-press-fitted":
        parameters.pop("stiffness")  # its own goes with its exponent
    runs = [
        run(
            name,
            duration,
            parameters=parameters,
            tolerance=1e-10,
            output_step=duration / 20,
            formulation=formulation,
        )
        for formulation in ("reduced", "lagrange")
    ]
    for found in runs:
        ledger = found.statistics["energy"]
        # ten times the tolerance, and the rounding of some thousand steps
        assert abs(ledger["residual"]) <= (10.0 * 1e-10 + 1e-12) * ledger["gross_work"]
    for channel in runs[0].admission.channels:
        kind = channel.name.split(".")[-1]
        if kind not in ("x", "y", "theta"):
            continue
        # both are good to about the tolerance a step, some thousand steps, in units of 0.1 m
        np.testing.assert_allclose(
            runs[1][channel.name], runs[0][channel.name], rtol=0, atol=1e-6, err_msg=channel.name
        )


# failure


def test_a_run_that_cannot_go_on_says_when_and_what_to_try() -> None:
    # links that reach only part of a revolution: the ideal mechanism locks at a dead point
    scene = presets.document("slider-crank")
    scene["parameters"], scene["outputs"] = {}, []
    scene["joints"]["P"]["clearance"]["radial_clearance"] = 0.0
    scene["bodies"]["rod"]["points"] = {"crank": [-0.02, 0.0], "slider": [0.02, 0.0]}
    simulation = Simulation(admit({"kind": "simulate", "scene": scene, "duration": 0.012}))
    with pytest.raises(SimulationFailed) as failed:
        list(simulation.slices())
    assert failed.value.code == "assembly-lost"
    assert "dead point" in failed.value.detail
    # the rod of 40 mm cannot follow the pin of the 50 mm crank past asin(0.8)
    locked = math.asin(0.8) / 523.5987755982989
    assert failed.value.time == pytest.approx(locked, abs=1e-12)


def test_a_step_size_underflow_keeps_what_was_computed_and_says_what_to_try() -> None:
    # stiff beyond reason, full friction at any slip: the step cannot cross the jump of friction
    parameters = {
        "stiffness": 1e18,
        "restitution": 1.0,
        "friction": 10.0,
        "static_velocity": 0.0,
        "dynamic_velocity": 1e-12,
        "velocity_x": 0.1,
        "spin": 1000.0,
    }
    scene = {"preset": "bouncing-journal", "parameters": parameters}
    job = {"kind": "simulate", "scene": scene, "duration": 0.05, "tolerance": 1e-10}
    simulation = Simulation(admit(job))
    slices: list[Slice] = []
    with pytest.raises(SimulationFailed) as failed:
        slices.extend(simulation.slices())
    assert failed.value.code == "step-size-underflow"
    assert 0.0 < failed.value.time < 0.05
    assert f"t = {failed.value.time:.9g} s" in failed.value.detail
    assert "dynamic_velocity" in failed.value.detail
    kept = np.concatenate([found.sample_time for found in slices])
    # every sample up to the failure, 2000 of them over the duration
    assert len(kept) == math.floor(failed.value.time / (0.05 / 2000)) + 1
    assert all(np.isfinite(found.samples).all() for found in slices)
    assert slices[-1].time == pytest.approx(failed.value.time, rel=1e-12)
    summary = simulation.summary()
    assert summary.peaks["journal.x"].maximum_time <= failed.value.time
    assert summary.statistics["onsets"] >= 1
