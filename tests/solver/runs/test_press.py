"""The paper's press: the numbers that the requirement states, on both formulations."""

import numpy as np
import pytest

from tests.solver.completed_runs import CASE_3, Run, run

DIGITS = {
    "slider7.x": 1.9492762956,
    "slider7.vx": -0.0544643880,
    "link2.theta": -0.0209868268,
    "link3.theta": 0.6219392003,
}
"""Case 3 at t = 0.03 s; three independent programs agree on these digits."""


def case_3(tolerance: float, formulation: str = "reduced") -> Run:
    return run(
        "seven-bar-press",
        0.03,
        parameters=CASE_3,
        tolerance=tolerance,
        formulation=formulation,
        output_step=0.03,
    )


def test_the_ideal_press_has_the_stroke_and_the_extremes_of_exact_kinematics() -> None:
    names = ["displacement", "slider7.vx", "slider7.ax"]
    ideal = run("seven-bar-press", 2.0, parameters={"clearance": 0.0}, channels=names)
    stroke = ideal.peaks["displacement"]
    # half a unit of the last digits that are stated
    assert stroke.maximum == pytest.approx(0.528141, abs=1e-6)
    assert stroke.maximum_time == pytest.approx(0.9964, abs=5e-5)
    for channel, lowest, highest in (
        ("slider7.vx", -0.9954, 0.9827),
        ("slider7.ax", -3.7935, 2.8003),
    ):
        found = ideal.peaks[channel]
        assert (found.minimum, found.maximum) == pytest.approx((lowest, highest), abs=5e-5)


@pytest.mark.parametrize(("clearance", "peak"), [(1e-4, 527.931), (3e-4, 527.553), (5e-4, 527.156)])
def test_clearance_lowers_the_stroke(clearance: float, peak: float) -> None:
    parameters = {**CASE_3, "clearance": clearance, "friction": 0.01}
    found = run(
        "seven-bar-press",
        2.0,
        parameters=parameters,
        tolerance=1e-9,
        channels=["displacement"],
        output_step=0.01,
    )
    assert 1e3 * found.peaks["displacement"].maximum == pytest.approx(peak, abs=5e-3)


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_case_3_agrees_with_three_independent_programs(formulation: str) -> None:
    found = case_3(1e-11, formulation)
    np.testing.assert_allclose(found.last(*DIGITS), list(DIGITS.values()), rtol=0, atol=1e-8)


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_the_first_impact_at_a_has_its_force_and_time(formulation: str) -> None:
    first = case_3(1e-11, formulation).contacts("A")[0]
    assert first["peak_force"] == pytest.approx(1029.631, abs=5e-4)
    found = run(
        "seven-bar-press",
        0.00999,  # the first contact peaks before, and still lasts
        parameters=CASE_3,
        tolerance=1e-11,
        formulation=formulation,
        channels=["A.normal_force"],
    ).peaks["A.normal_force"]
    assert found.maximum == pytest.approx(1029.631, abs=5e-4)
    assert found.maximum_time == pytest.approx(9.6405e-3, abs=5e-8)


def test_the_standard_tolerance_keeps_its_promise() -> None:
    errors = np.abs(case_3(1e-6).last(*DIGITS) - list(DIGITS.values()))
    assert errors[0] <= 3e-7
    assert errors[1] <= 1.5e-4


def test_errors_fall_with_the_tolerance() -> None:
    # Tsit5 controls an error of order h^5, so a hundredfold tolerance shortens steps by 2.5 and
    # the global error follows it in proportion, give or take the luck of where impacts fall: a
    # factor of at least 5 of the 100 a step, and 1000 over both
    truth = case_3(1e-12).last(*DIGITS)
    scale = np.array([1e-6, 1e-3, 1e-5, 1e-5])
    errors = [
        float(np.abs((case_3(tolerance).last(*DIGITS) - truth) / scale).max())
        for tolerance in (1e-6, 1e-8, 1e-10)
    ]
    assert errors[1] <= errors[0] / 5
    assert errors[2] <= errors[1] / 5
    assert errors[2] <= errors[0] / 1000


@pytest.mark.parametrize("tolerance", np.geomspace(1e-6, 1e-8, 61)[[4, 7, 9, 13, 29, 30]])
def test_no_short_opening_is_lost_between_step_ends(tolerance: float) -> None:
    # joint A opens for 0.2 ms at 26 ms, less than two steps: by luck of where steps end, its gap
    # may be on its way back already where it is first seen open, or closed again
    found = run(
        "seven-bar-press",
        0.03,
        parameters=CASE_3 | {"clearance": 3e-4, "friction": 0.01},
        tolerance=float(tolerance),
        output_step=0.03,
        certificate=False,
    ).contacts("A")
    assert len(found) == 5
    assert found["release"][3] == pytest.approx(0.0260530, abs=1e-6)
    assert found["onset"][4] == pytest.approx(0.0262791, abs=1e-6)
    assert found["approach_rate"][4] == pytest.approx(0.002766, rel=1e-2)


def test_the_cranks_give_the_punch_its_power_on_the_way_down_alone() -> None:
    powers = ["drive1.power", "drive4.power"]
    ideal, punching = (
        run(name, 2.0, parameters={"clearance": 0.0}, output_step=2e-3, channels=channels)
        for name, channels in (
            ("seven-bar-press", powers),
            ("seven-bar-press-punching", [*powers, "punch.force", "slider7.vx"]),
        )
    )
    idle, loaded = (run["drive1.power"] + run["drive4.power"] for run in (ideal, punching))
    force, speed = punching["punch.force"], punching["slider7.vx"]
    np.testing.assert_allclose(loaded - idle, force * speed, rtol=0.0, atol=1e-9 * 2000.0)
    assert 1900.0 < force.max() < 2200.0  # a spline through its values swings a little over them
    assert not force[speed < 0.0].any()
    # once a revolution, over the sheet's 8 mm: a trapezium 6 mm wide at half its height
    work = np.trapezoid(force * speed, punching.time)
    assert work == pytest.approx(2000.0 * 6e-3, rel=0.03)
