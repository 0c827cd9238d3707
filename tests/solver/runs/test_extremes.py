"""At the ends of the ranges a run is finite and its energy closes, or it says what to change."""

import math
import random
from pathlib import Path

import numpy as np
import pytest

from benchmarks.extreme_cases import ALL, Case, coverage_of, outcome_of
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation
from tests.solver.completed_runs import run

TYPED = {
    "dead points: rod too short, ideal": ("assembly-lost", "Change lengths"),
    "tolerance: journal, 0.01": ("refused", "ask for 0.001 at most"),
    "tolerance: press, 0.01": ("refused", "ask for 0.001 at most"),
}
"""The cases that cannot be done, and what says so."""
WITHOUT_TRUTH = {
    "friction: journal, v0 = v1 = 1e-3 m/s",  # friction that jumps: a finer run chatters about it
    "friction: press, v0 = v1 = 1e-3 m/s",
    "tolerance: journal, 1e-11",  # none is finer by enough
    "tolerance: press, 1e-11",
    "tolerance: journal, 1e-13",
    "tolerance: press, 1e-13",
}
"""The cases that are done, but of which no finer run tells the true error."""
AT_LENGTH = {"dead points: rod too short, with clearance"}
"""Cases of many steps."""
JUDGED = [
    case for case in ALL if not case.long and case.id not in TYPED and case.id not in WITHOUT_TRUTH
]
SAMPLE = random.Random(5).sample([case for case in JUDGED if isinstance(case.scene, str)], 16)
"""Cases of presets: the tangents of other scenes take seconds to compile."""


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, id=case.id, marks=[pytest.mark.long] * long)
        for case in ALL
        for long in (case.long or case.id in AT_LENGTH,)
    ],
)
def test_an_extreme_ends_well(case: Case) -> None:
    found = outcome_of(case)
    ended, advice = TYPED.get(case.id, ("done", ""))
    assert found.ended == ended
    assert advice in found.detail
    assert found.finite
    assert found.closure <= 10.0
    if ended == "done":
        assert found.reached == case.duration
        assert found.steps > 0


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, id=case.id, marks=() if case in SAMPLE else pytest.mark.long)
        for case in JUDGED
    ],
)
def test_the_certificate_covers_the_error_at_an_extreme(case: Case) -> None:
    found = coverage_of(case.job)
    assert found is not None
    assert found.covered >= 0.95
    assert found.known >= 0.9  # else the reference, not the estimate, would be judged


@pytest.mark.parametrize("clearance", [1e-3, 1e-5, 1e-7])
def test_with_the_clearance_the_press_tends_to_the_ideal_one(clearance: float) -> None:
    # bearings so stiff that they give by less than the smallest clearance: 30 N press them in by
    # (30 / 1e15)^(2/3) = 1e-9 m
    parameters = {"clearance": clearance, "stiffness": 1e15, "bearing_radius": 0.01}
    ideal, real = (
        run("seven-bar-press", 0.5, parameters=given, output_step=0.005)
        for given in ({"clearance": 0.0}, parameters)
    )
    away = np.abs(real["slider7.x"] - ideal["slider7.x"]).max() / clearance
    # A moves the slider by itself, B by as much again, and more where the two links are in line
    assert 1.0 < away < 3.0


def test_an_output_step_longer_than_the_run_gives_both_its_ends() -> None:
    found = run("bouncing-journal", 0.05, output_step=10.0)
    assert found.time.tolist() == [0.0, 0.05]


@pytest.mark.parametrize("rate", [1e-9, 1e-10])
def test_the_softest_touch_is_an_onset(rate: float) -> None:
    case = next(case for case in ALL if case.id == f"grazing: journal, {rate:g} m/s")
    contact = run(case.scene, case.duration).contacts("bearing")
    assert len(contact) == 1
    # a hundredth of a second away; positions of 1 mm are rounded at 2e-19 m
    assert contact["onset"][0] == pytest.approx(0.01, abs=1e-3)
    assert contact["approach_rate"][0] == pytest.approx(rate, rel=1e-6)


# a run of its own for what needs more than a summary


@pytest.mark.long
def test_ten_thousand_revolutions_neither_drift_nor_grow() -> None:
    job = {
        "kind": "simulate",
        "scene": {"preset": "seven-bar-press"},
        "duration": 20_000.0,
        "output_step": 2.0,
        "channels": ["crank1.theta", "crank1.x", "slider7.x", "energy.kinetic"],
        "certificate": False,
    }
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    times, values, memory = [], [], []
    for piece in simulation.slices():
        times.append(piece.sample_time)
        values.append(piece.samples)
        memory.append(_resident())
    time, columns = np.concatenate(times), np.concatenate(values).T
    named = dict(zip([channel.name for channel in admission.channels], columns, strict=True))
    angle, x, slider, kinetic = (named[name] for name in job["channels"])
    np.testing.assert_array_equal(time, 2.0 * np.arange(10_001))
    # 63 000 rad, and a pin of the crank that is back after each revolution, to their rounding
    np.testing.assert_allclose(angle, math.pi * time, rtol=1e-15, atol=1e-15)
    assert np.ptp(x) < 1e-15
    # the press neither heats up nor tires: the last thousand revolutions are like the second
    for channel in (slider, kinetic):
        early, late = channel[1000:2000], channel[-1000:]
        assert abs(late.mean() - early.mean()) < 5.0 * early.std() + 1e-9
    energy = simulation.summary().statistics["energy"]
    assert abs(energy["residual"]) < 10.0 * 1e-6 * energy["gross_work"]
    # rows are kept by this test: 10 000 of five numbers; slices and their times take the rest
    assert memory[-1] - memory[len(memory) // 10] < 8e6


def _resident() -> int:
    """Memory of this process, bytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


def test_a_run_ends_at_its_limit_of_seconds_with_what_it_has() -> None:
    admission = admit(
        {"kind": "simulate", "scene": {"preset": "bouncing-journal"}, "duration": 1000.0}
    )
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    slices = []
    with pytest.raises(SimulationFailed, match="shorter duration") as failed:
        slices.extend(simulation.slices(1e-3))
    assert failed.value.code == "time-limit"
    assert failed.value.time == slices[-1].time
    assert 0.0 < failed.value.time < 1000.0
    assert simulation.summary().statistics["steps"] > 0
