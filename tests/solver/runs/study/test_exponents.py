"""Exponents of a study's points: what tangent vectors give, and what they leave alone."""

import math
from collections import defaultdict
from typing import Any

import numpy as np
import pytest

from benchmarks.lies.named.exponents import LIES, Lie, bouncing_ball, job
from jointplay.solver.kinds import Study, admit
from jointplay.solver.nonlinear.verdict import CHAOTIC, PERIODIC
from jointplay.solver.runs import budget
from jointplay.solver.runs.study.run import StudyRun
from tests.solver.completed_runs import CASE_3
from tests.solver.runs.study.test_run import Computed

SETTINGS = {name: value for name, value in CASE_3.items() if name != "dynamic_velocity"}
DIAGRAM: dict[str, Any] = {
    "kind": "bifurcation",
    "scene": {"preset": "seven-bar-press", "parameters": SETTINGS},
    "parameter": "dynamic_velocity",
    "values": [1e-3, 1e-2],
    "settle": 1,
    "record": 8,
    "tolerance": 1e-6,
}


def test_exponents_change_no_section_and_are_not_known_where_friction_jumps() -> None:
    with_exponents = Computed({**DIAGRAM, "indicators": ["lyapunov"]})
    without = Computed(DIAGRAM)
    for point in range(2):
        assert with_exponents.ends[point].code == ""
        assert np.array_equal(with_exponents.sections(point), without.sections(point))
    # the static velocity is 1e-3, too
    jump, ramp = (with_exponents.ends[point].indicators for point in range(2))
    assert math.isnan(jump["lyapunov"])
    # eight revolutions tell little: a regular motion (-0.09 at tighter tolerances), and an error
    # that depends on how a single step happens to pass a kink of friction
    assert -0.2 < ramp["lyapunov"] < 0.0
    assert abs(ramp["lyapunov"]) < ramp["lyapunov_error"] < 10.0


def test_a_fast_press_is_chaotic_by_its_exponent() -> None:
    scene = {
        "preset": "seven-bar-press",
        "parameters": CASE_3 | {"speed": 7.854, "speed_crank4": -7.854},
    }
    job = {"kind": "poincare", "scene": scene, "settle": 20, "record": 100, "tolerance": 1e-6}
    end = Computed({**job, "indicators": ["lyapunov"]}).ends[0]
    # 6.9 +- 0.1 over longer runs at tolerances down to 1e-11; over these hundred periods 5.9 to
    # 7.1 with errors of 0.45 to 0.75, at tolerances from 1e-6 to 1e-9
    assert abs(end.indicators["lyapunov"] - 6.9) < 1.5
    # no better than the eight periods in smaller steps, that is three times as much
    assert 0.2 < end.indicators["lyapunov_error"] < 2.5
    assert end.indicators["verdict"] == CHAOTIC


def test_a_ball_that_is_hit_once_a_turn_has_the_exponent_of_its_spin() -> None:
    found = Computed(job(bouncing_ball(), 200, 100, tolerance=1e-6)).ends[0].indicators
    # a few steps for an impact that takes a five-hundredth of the flight: what they lose of its
    # stiffness would be an exponent of 15 1/s; the spin's falls like the logarithm of time by time
    assert found["period"] == 1.0
    assert 0.0 < found["lyapunov"] < 0.2
    assert found["verdict"] == PERIODIC


@pytest.mark.parametrize(
    "lie",
    [
        pytest.param(lie, id=lie.name, marks=[pytest.mark.long] * lie.name.startswith("press"))
        for lie in LIES
    ],
)
def test_the_true_exponent_is_within_three_errors(lie: Lie) -> None:
    found = lie.judge()
    assert found.true, found.said


def test_progress_counts_the_stretch_in_smaller_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget, "FIRST", 311)
    monkeypatch.setattr(budget, "LARGEST", 311)
    study = admit({**DIAGRAM, "values": [1e-2], "indicators": ["lyapunov"]})
    assert isinstance(study, Study)
    progress = [(piece.fraction, len(piece.rows)) for piece in StudyRun(study, 0).slices()]
    fractions = [fraction for fraction, _ in progress]
    assert fractions == sorted(fractions)
    recorded = max(fraction for fraction, rows in progress if rows)
    # nine periods, and eight behind them of two and a half times as many steps
    assert recorded == pytest.approx(9.0 / (9.0 + 8.0 * 2.5), abs=0.05)
    assert fractions[-1] == 1.0


@pytest.mark.long
def test_an_exponent_interrupted_anywhere_has_the_same_bits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = Computed({**DIAGRAM, "indicators": ["lyapunov"], "record": 2})
    monkeypatch.setattr(budget, "FIRST", 311)
    monkeypatch.setattr(budget, "LARGEST", 977)
    disturbed = Computed.__new__(Computed)
    disturbed.study = whole.study
    disturbed.ends, disturbed.rows, disturbed.times = {}, defaultdict(list), defaultdict(list)
    checkpoint: bytes | None = None
    interrupted = 0
    while len(disturbed.ends) < 2:
        checkpoint = disturbed.take(StudyRun(whole.study, 0, checkpoint), 9)
        interrupted += 1
    assert interrupted > 3  # in the record, and behind it
    assert disturbed.bytes() == whole.bytes()


GRAVITY = 9.81
PRESSED: dict[str, Any] = {
    "name": "pressed",
    "gravity": [GRAVITY, 0.0],
    "ground": {"points": {"guide": [0.0, 0.0], "stop": [-0.2, 0.0]}},
    "bodies": {"mass": {"mass": 1.0, "inertia": 1e-3, "points": {"centre": [0.0, 0.0]}}},
    "joints": {
        "guide": {
            "type": "prismatic",
            "guide": "ground.guide",
            "slider": "mass.centre",
            "axis": [1.0, 0.0],
        },
        "stop": {
            "type": "revolute",
            "bearing": "ground.stop",
            "journal": "mass.centre",
            "clearance": {
                "radial_clearance": 0.2,
                "bearing_radius": 0.3,
                "contact": {
                    "law": "stiffness-and-dissipation",
                    "stiffness": {"law": "power", "stiffness": 1e4, "exponent": 1.0},
                    "dissipation": {"law": "lankarani-nikravesh", "restitution": 0.3},
                },
            },
        },
    },
    "forces": {
        "shaking": {
            "type": "force",
            "first": "ground.guide",
            "second": "mass.centre",
            "magnitude": 2.0,
            "direction": [1.0, 0.0],
            "course": {"type": "sinusoidal", "amplitude": 1.0, "frequency": 30.0},
        }
    },
}
"""A mass that falls on a stop, stays there, and is shaken: its only contact lasts."""


@pytest.mark.parametrize("settle", [1, 10, "auto"])
def test_an_impact_rate_that_contact_keeps_is_no_neutral_direction(settle: int | str) -> None:
    rate = 0.05
    start = {"joints": {"stop": {"eccentricity": [0.2 - rate**2 / (2.0 * GRAVITY), 0.0]}}}
    job = {"kind": "poincare", "scene": PRESSED | {"start": start}, "settle": settle, "record": 60}
    found = Computed({**job, "indicators": ["lyapunov", "recurrence"]}).ends[0].indicators
    # both multipliers have the product exp(-∫ D dt) with D = χ K δ / (the impact's rate); in the
    # mean K δ carries the weight, and χ = 3 (1 - e²) / 4. The force shakes the fall by 1 %.
    expected = -0.5 * 0.75 * (1.0 - 0.3**2) * GRAVITY / rate
    assert found["lyapunov"] == pytest.approx(expected, rel=0.02)
    assert found["lyapunov_error"] < 2.0
    assert found["verdict"] == PERIODIC


def falling(fall: float, frequency: float) -> dict[str, Any]:
    """Return the mass that is pressed, from so far above the stop, m; it is shaken by rad/s."""
    shaking = PRESSED["forces"]["shaking"]
    faster = {"shaking": shaking | {"course": shaking["course"] | {"frequency": frequency}}}
    start = {"joints": {"stop": {"eccentricity": [0.2 - fall, 0.0]}}}
    return PRESSED | {"start": start, "forces": faster}


def test_an_impact_rate_is_forgotten_of_a_contact_that_begins_in_the_record_and_lasts() -> None:
    # a fall of two periods, a bounce, and a contact that lasts: it begins in the third of 200
    scene, found = falling(0.2**2 / (2.0 * GRAVITY), 100.0), {}
    for settle in (1, 20):
        job = {"kind": "poincare", "scene": scene, "settle": settle, "record": 200}
        end = Computed({**job, "indicators": ["lyapunov", "recurrence"]}).ends[0]
        found[settle] = end.indicators
        assert ("from the record on" in end.reason) == (settle == 1)
        assert ("throughout" in end.reason) == (settle == 20)
    # with the contact begun before the record the exponent is that of the closed form above
    assert found[20]["lyapunov"] == pytest.approx(-61.2, abs=1.0)
    assert found[1]["lyapunov"] == pytest.approx(found[20]["lyapunov"], rel=0.02)
    assert found[1]["verdict"] == PERIODIC


def test_an_impact_rate_is_forgotten_of_a_contact_that_begins_late_in_the_record() -> None:
    # bounces of 121 periods: contact lasts from the 122nd of 200 on, with 0.187 m/s
    job = {"kind": "poincare", "scene": falling(0.35, 600.0), "settle": 1, "record": 200}
    end = Computed({**job, "indicators": ["lyapunov"]}).ends[0]
    rate = 0.1870
    assert f"from the record on in stop ({rate:.3g} m/s" in end.reason
    expected = -0.5 * 0.75 * (1.0 - 0.3**2) * GRAVITY / rate  # as above
    # it oscillates with 100 rad/s behind the last impact, slowly damped; its weight is the mean
    assert end.indicators["lyapunov"] == pytest.approx(expected, abs=2.0)
    assert end.indicators["lyapunov_error"] < 5.0
