"""Statistics of a sweep's points: of known motions, of stored samples, undisturbed and resumed."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs import budget
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.statistics import OF_CHANNELS, OF_CONTACTS
from tests.solver.completed_runs import CASE_3
from tests.solver.runs.study.test_run import Computed

EVERY = [*OF_CHANNELS, *OF_CONTACTS]
# it bounces in its joints at twice the speed: contacts begin and end
PRESS: dict[str, Any] = {
    "kind": "sweep",
    "scene": {"preset": "seven-bar-press", "parameters": CASE_3 | {"speed": 2.5 * math.pi}},
    "grid": {"clearance": [5e-4, 2e-4, 8e-4]},
    "channels": ["slider7.x", "A.normal_force", "displacement"],
    "periods": 1.5,
    "settle": 0.3,
}
PERIOD = 0.8


@pytest.fixture(scope="module")
def press() -> Computed:
    return Computed(PRESS | {"statistics": EVERY})


def test_without_statistics_nothing_else_is_another_number(press: Computed) -> None:
    plain = Computed(PRESS)
    for point, end in plain.ends.items():
        with_them = press.ends[point]
        assert end.peaks.tobytes() == with_them.peaks.tobytes()
        kept = {name: with_them.statistics[name] for name in end.statistics}
        assert repr(kept) == repr(end.statistics)


def test_they_are_those_of_a_simulation_s_samples_and_contacts() -> None:
    duration, step = 1.5 * PERIOD, PERIOD / 256
    times = {"duration": duration, "output_step": step}
    admission = admit({"kind": "simulate", "scene": PRESS["scene"], **times})
    assert isinstance(admission, Admission)
    slices = list(Simulation(admission).slices())
    # the last of the 385 samples, at the end, begins what would come next
    samples = np.concatenate([piece.samples for piece in slices])[:-1]
    impacts = np.concatenate([piece.impacts for piece in slices])
    grid = {"clearance": [CASE_3["clearance"]]}
    swept = Computed(PRESS | {"statistics": EVERY, "grid": grid, "settle": 0.0})
    found = swept.ends[0].statistics
    names = [channel.name for channel in admission.channels]
    for channel in PRESS["channels"]:
        column = samples[:, names.index(channel)]
        for name, expected in (
            ("mean", column.mean()),
            ("root_mean_square", np.sqrt((column * column).mean())),
            ("standard_deviation", column.std()),
            ("mean_absolute", np.abs(column).mean()),
            ("quantile_05", np.quantile(column, 0.05)),
            ("median", np.median(column)),
            ("quantile_95", np.quantile(column, 0.95)),
        ):
            # sums of 384 terms in another order
            assert math.isclose(found[f"{channel}.{name}"], expected, rel_tol=1e-12), name
    for index, joint in enumerate(("A", "B")):
        own = impacts[impacts["joint"] == index]
        lasted = np.where(np.isnan(own["release"]), duration, own["release"]) - own["onset"]
        assert found[f"{joint}.impacts"] == len(own) > 10
        assert found[f"{joint}.largest_impact_force"] == own["peak_force"].max()
        assert math.isclose(found[f"{joint}.contact_share"], lasted.sum() / duration)


def test_they_are_over_the_time_after_settling(press: Computed) -> None:
    """A driven crank's angle is known at each of the samples 77 to 383: 0.3 * 256 is 76.8."""
    cranked = Computed(PRESS | {"channels": ["crank1.theta"], "statistics": ["mean", "median"]})
    scene = cranked.study.point_scene(0)
    driver = next(iter(scene.drivers.values()))
    index = np.arange(77, 384)
    angle = driver.position + 2.0 * math.pi * index / 256
    for end in cranked.ends.values():
        assert math.isclose(end.statistics["crank1.theta.mean"], angle.mean(), rel_tol=1e-12)
        assert math.isclose(end.statistics["crank1.theta.median"], angle[153], rel_tol=1e-12)
    impacts = press.ends[0].statistics["A.impacts"]
    assert 0.0 < impacts < press.ends[0].statistics["onsets"]


def test_a_pendulum_of_small_swing_has_the_statistics_of_a_sine() -> None:
    """About its lowest point, over ten of its swings after the first two."""
    swing, length, inertia = 0.01, 0.5, 1.0 / 12.0
    # the elliptic integral adds a sixteenth of the amplitude's square: 6e-6
    second = 2.0 * math.pi * math.sqrt((inertia + length**2) / (9.81 * length))
    names = ["mean", "root_mean_square", "standard_deviation", "mean_absolute", "quantile_95"]
    document = {
        "kind": "sweep",
        "scene": {"preset": "pendulum"},
        "points": [{"angle": swing - 0.5 * math.pi}],
        "channels": ["rod.theta", "rod.omega"],
        "statistics": names,
        "settle": 2.0 * second,
        "duration": 12.0 * second,
    }
    found = Computed(document).ends[0].statistics
    rate = swing * 2.0 * math.pi / second
    # of some 2100 samples the last one and the first may be cut differently: 5e-4 of the whole
    assert math.isclose(found["rod.theta.mean"], -0.5 * math.pi, abs_tol=5e-4 * swing)
    deviation = found["rod.theta.standard_deviation"]
    assert math.isclose(deviation, swing / math.sqrt(2.0), rel_tol=5e-4)
    rms = found["rod.omega.root_mean_square"]
    assert math.isclose(rms, rate / math.sqrt(2.0), rel_tol=5e-4)
    assert math.isclose(found["rod.omega.mean_absolute"], rate * 2.0 / math.pi, rel_tol=5e-4)
    upper = found["rod.omega.quantile_95"]
    # one sample more or less above the level moves it by the slope of the sine there
    assert math.isclose(upper, rate * math.cos(0.05 * math.pi), rel_tol=1e-3)


def test_a_journal_that_bounces_for_ever_is_carried_by_its_impacts() -> None:
    """Over whole bounces the mean force is the weight; energy gives an elastic impact's course."""
    clearance, stiffness, gravity, bounces = 5e-4, 1e9, 9.81, 20

    def speed_squared(depth: Any) -> Any:
        return 2.0 * gravity * (clearance + depth) - 0.8 * stiffness * depth**2.5  # of 1 kg

    deepest = brentq(speed_squared, 1e-6, 1e-3, xtol=1e-18)
    half = (np.arange(20_000) + 0.5) / 20_000  # depth = deepest (1 - half^2): no singular end
    course = 2.0 * deepest * half / np.sqrt(speed_squared(deepest * (1.0 - half**2)))
    impact, flight = 2.0 * course.mean(), 2.0 * math.sqrt(2.0 * clearance / gravity)
    duration = bounces * (flight + impact)
    document = {
        "kind": "sweep",
        "scene": {
            "preset": "bouncing-journal",
            "parameters": {"restitution": 1.0, "friction": 0.0, "stiffness": stiffness},
        },
        "points": [{"clearance": clearance}],
        "channels": ["bearing.normal_force"],
        "statistics": ["mean", "impacts", "contact_share", "largest_impact_force"],
        "samples_per_period": 4096,
        "duration": duration,
        "tolerance": 1e-9,
    }
    found = Computed(document).ends[0].statistics
    assert found["bearing.impacts"] == bounces
    force = stiffness * deepest**1.5
    # twenty impacts at 1e-9 a step
    assert math.isclose(found["bearing.largest_impact_force"], force, rel_tol=1e-5)
    share = impact / (flight + impact)
    assert math.isclose(found["bearing.contact_share"], share, rel_tol=1e-5)
    # some twenty samples in an impact whose force begins and ends as the power 1.5
    assert math.isclose(found["bearing.normal_force.mean"], gravity, rel_tol=2e-3)


def test_interrupted_anywhere_and_resumed_they_have_the_same_bits(
    press: Computed, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(budget, "FIRST", 311)
    monkeypatch.setattr(budget, "LARGEST", 977)
    ends: dict[int, str] = {}
    checkpoint: bytes | None = None
    for most in (1, 3, 7, 10**9):
        run = StudyRun(press.study, 0, checkpoint)
        for number, piece in enumerate(run.slices(), start=1):
            ends |= {end.point: repr(end.statistics) for end in piece.ended}
            if number == most:
                checkpoint = run.checkpoint()
                break
    assert ends == {point: repr(end.statistics) for point, end in press.ends.items()}
