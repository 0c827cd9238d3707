"""Samples, sections, impacts and peaks: complete, at their times, and consistent."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.kinds.simulate import sample_count
from tests.solver.completed_runs import CASE_3, Run, run

# samples


@given(st.floats(1e-9, 1e9), st.floats(1.0, 1e6))
def test_the_number_of_samples_is_that_of_exact_arithmetic(duration: float, ratio: float) -> None:
    step = duration / ratio
    exact = Fraction(duration) / Fraction(step)
    count = sample_count(duration, step)
    # samples k * step before the duration, then the duration; within 1e-9 of a step of a whole
    # number, the last grid sample and the duration are the same one
    whole = round(exact)
    if abs(exact - whole) <= Fraction(1, 10**9):
        assert count in (whole + 1, math.ceil(exact) + 1)
        if abs(exact - whole) <= Fraction(1, 10**12):
            assert count == max(whole, 1) + 1
    else:
        assert count == math.ceil(exact) + 1


@given(st.integers(1, 10**6), st.floats(1e-6, 1e3))
def test_a_duration_of_whole_steps_has_one_sample_more_than_steps(n: int, step: float) -> None:
    assert sample_count(n * step, step) == n + 1


@given(st.integers(1, 10**6), st.floats(1e-6, 1e3))
def test_a_step_that_is_a_whole_part_of_the_duration_fills_it(n: int, duration: float) -> None:
    assert sample_count(duration, duration / n) == n + 1


@pytest.mark.parametrize(
    ("duration", "step"),
    [
        (0.1, 0.1),
        (0.1, 0.3),
        (0.3, 0.1),
        (0.7, 0.1),
        (0.1, 0.1 / 3.0),
        (1.0, 0.3),
        (0.1, 0.1 * (1.0 - 1e-13)),
        (0.1, math.nextafter(0.1, 0.0)),
        (0.1, math.nextafter(0.1, 1.0)),
        (0.5, 0.017),
        (1e-9, 1e-9),
        (1e-9, 3e-10),
    ],
)
@pytest.mark.parametrize("clearance", [1e-3, 0.0])
def test_samples_stand_on_the_grid_and_the_duration_is_last(
    duration: float, step: float, clearance: float
) -> None:
    if clearance:
        found = run("bouncing-journal", duration, output_step=step, tolerance=1e-5)
    else:
        found = run(
            "slider-crank",
            duration,
            output_step=step,
            parameters={"clearance": 0.0, "speed": 9.0},
            channels=["slider.x", "slider.ax", "Q.force_x"],
        )
    count = found.admission.samples
    assert len(found.time) == count == sample_count(duration, step)
    # a sample's time is a product, or period and local time added: a rounding or two
    np.testing.assert_allclose(found.time[:-1], np.arange(count - 1) * step, rtol=4e-16)
    assert found.time[-1] == duration
    assert (np.diff(found.time) > 0.0).all()
    for values in found.samples.values():
        assert len(values) == count
        assert np.isfinite(values).all()


@given(st.floats(0.01, 0.05), st.floats(0.3, 1500.0))
def test_every_sample_that_was_promised_arrives(duration: float, ratio: float) -> None:
    found = run(
        "bouncing-journal",
        duration,
        output_step=duration / ratio,
        tolerance=1e-5,
        channels=["journal.y"],
    )
    assert len(found.time) == found.admission.samples
    assert found.time[-1] == duration


def test_samples_do_not_depend_on_how_they_are_spaced() -> None:
    # the dense output is a function of time: two grids agree where they meet
    fine = run("bouncing-journal", 0.06, output_step=1e-4, tolerance=1e-6)
    coarse = run("bouncing-journal", 0.06, output_step=3e-4, tolerance=1e-6)
    meet = fine.time[::3]
    np.testing.assert_allclose(coarse.time, meet, rtol=4e-16)
    for name, values in coarse.samples.items():
        scale = np.abs(values).max() + 1e-300
        # times differ in their last digit, 1e-17 s, times the steepest rate, 1e4/s
        np.testing.assert_allclose(fine[name][::3], values, rtol=0, atol=1e-10 * scale)


# the press, sampled densely, as its own judge


@pytest.fixture(scope="module")
def press() -> Run:
    return run(
        "seven-bar-press",
        0.7,
        parameters={**CASE_3, "speed": 20.0},
        output_step=0.7 / 20_000,
        tolerance=1e-8,
        section={"crank_angle": 1.0},
    )


def test_sections_fall_on_their_crank_angle(press: Run) -> None:
    period = 2.0 * math.pi / 20.0
    assert press.admission.period == pytest.approx(period, rel=1e-15)
    assert press.admission.sections == len(press.section_time) == 3
    np.testing.assert_allclose(press.section_time, 0.05 + period * np.arange(3), rtol=1e-15)
    turns = 2.0 * math.pi * np.arange(3)
    np.testing.assert_allclose(press.sections["crank1.theta"], 1.0 + turns, rtol=1e-14)
    for name in ("slider7.x", "link2.theta", "A.eccentricity_x"):
        nearby = np.interp(press.section_time, press.time, press[name])
        # linear interpolation over 35 µs of accelerations up to 1e4 per s²: h² a / 8
        np.testing.assert_allclose(press.sections[name], nearby, rtol=0, atol=2e-6)


def test_impacts_are_ordered_complete_and_consistent_with_the_samples(press: Run) -> None:
    releases = press.impacts["release"]
    assert (np.diff(releases[np.isfinite(releases)]) >= 0.0).all()
    assert len(press.impacts) == press.statistics["onsets"] >= 20
    for joint in press.admission.joints:
        contacts = press.contacts(joint)
        depth, force = press[f"{joint}.penetration"], press[f"{joint}.normal_force"]
        until = np.where(np.isnan(contacts["release"]), math.inf, contacts["release"])
        assert (contacts["onset"] < until).all()
        assert (until[:-1] <= contacts["onset"][1:]).all()
        touching = np.zeros(len(press.time), dtype=bool)
        for contact, end in zip(contacts, until, strict=True):
            touching |= (press.time >= contact["onset"]) & (press.time <= end)
            assert contact["peak_force"] > 0.0
            assert contact["impulse"] > 0.0
        # an onset is located to 1e-13 m; after it, force and penetration go together
        assert (depth[~touching] <= 1e-12).all()
        assert (force[~touching] == 0.0).all()
        assert (force[depth < 0.0] == 0.0).all()
        assert (force >= 0.0).all()


def test_impulses_and_peak_forces_are_those_of_the_dense_samples(press: Run) -> None:
    for joint in press.admission.joints:
        force = press[f"{joint}.normal_force"]
        total = press.contacts(joint)["impulse"].sum()
        # trapezia over humps of hundreds of samples, whose kinks are at onset and release alone
        assert total == pytest.approx(np.trapezoid(force, press.time), rel=1e-5)
        for contact in press.contacts(joint):
            end = contact["release"] if np.isfinite(contact["release"]) else press.time[-1]
            inside = (press.time >= contact["onset"]) & (press.time <= end)
            if inside.any():
                assert contact["peak_force"] >= force[inside].max() * (1.0 - 1e-9)


def test_penetration_and_force_follow_the_law(press: Run) -> None:
    for joint in press.admission.joints:
        ex, ey = press[f"{joint}.eccentricity_x"], press[f"{joint}.eccentricity_y"]
        depth, force = press[f"{joint}.penetration"], press[f"{joint}.normal_force"]
        np.testing.assert_allclose(depth, np.hypot(ex, ey) - 5e-4, rtol=0, atol=1e-15)
        rate_x = press[f"{joint}.eccentricity_rate_x"]
        rate_y = press[f"{joint}.eccentricity_rate_y"]
        rate = (ex * rate_x + ey * rate_y) / np.maximum(np.hypot(ex, ey), 1e-300)
        for contact in press.contacts(joint):
            end = contact["release"] if np.isfinite(contact["release"]) else math.inf
            inside = (press.time > contact["onset"]) & (press.time < end)
            elastic = 5e9 * np.maximum(depth[inside], 0.0) ** 1.5
            # eqs 8 and 10; the impact rate is latched once, floored at 1 mm/s
            impact_rate = max(contact["approach_rate"], 1e-3)
            damped = elastic * (1.0 + 0.75 * (1.0 - 0.7**2) * rate[inside] / impact_rate)
            # depths of micrometres are differences of 0.5 mm, so keep ten digits
            np.testing.assert_allclose(force[inside], np.maximum(damped, 0.0), rtol=1e-8, atol=1e-6)
        friction = press[f"{joint}.friction_force"]
        assert (np.abs(friction) <= 0.1 * force * (1.0 + 1e-12)).all()
        assert (friction * press[f"{joint}.slip_velocity"] <= 0.0).all()
        fx, fy = press[f"{joint}.force_x"], press[f"{joint}.force_y"]
        np.testing.assert_allclose(np.hypot(fx, fy), np.hypot(force, friction), rtol=1e-9)


# peaks


def assert_peaks_bound(found: Run, margin: float) -> None:
    """Check every channel's extremes against its samples.

    No sample may lie outside, but for the rounding of the parabola that refines an extreme; and
    an extreme may lie outside the samples by no more than `margin` of the range: what a channel
    can do between two samples.
    """
    largest: dict[str, float] = {}
    for channel in found.admission.channels:
        value = float(np.abs(found[channel.name]).max())
        largest[channel.unit] = max(largest.get(channel.unit, 0.0), value)
    for channel in found.admission.channels:
        values, peak = found[channel.name], found.peaks[channel.name]
        spread = float(np.ptp(values))
        # a force that is zero but for rounding has no shape: 1e-10 of the largest is nothing
        nothing = 1e-10 * largest[channel.unit]
        assert peak.maximum >= values.max() - 1e-6 * spread - nothing, channel.name
        assert peak.minimum <= values.min() + 1e-6 * spread + nothing, channel.name
        assert peak.maximum <= values.max() + margin * spread + nothing, channel.name
        assert peak.minimum >= values.min() - margin * spread - nothing, channel.name
        for moment, value in (
            (peak.maximum_time, peak.maximum),
            (peak.minimum_time, peak.minimum),
        ):
            assert 0.0 <= moment <= found.time[-1]
            near = np.searchsorted(found.time, moment)
            around = values[max(near - 2, 0) : near + 3]
            assert abs(around - value).min() <= margin * spread + nothing, channel.name


def test_peaks_of_the_press_bound_all_samples(press: Run) -> None:
    # impacts last 0.2 ms and more, six samples: an extreme of a half sine is missed by at most
    # 1 - cos(pi / 12) = 3.4 % of its height, and kinks at onsets by as much again
    assert_peaks_bound(press, 0.1)


@pytest.mark.parametrize(
    ("name", "duration", "samples", "parameters"),
    [
        ("pendulum", 5.0, 20_000, {"angle": 1.0}),
        ("bouncing-journal", 0.1, 20_000, {}),
        ("slider-crank", 0.03, 20_000, {}),
        ("slider-crank", 0.03, 5_000, {"clearance": 0.0}),
        pytest.param(  # 3000 a revolution, without contacts
            *("seven-bar-press", 2.7, 20_000, {"clearance": 0.0}), marks=pytest.mark.long
        ),
    ],
)
def test_peaks_bound_all_samples(
    name: str, duration: float, samples: int, parameters: dict[str, float]
) -> None:
    found = run(
        name, duration, parameters=parameters, output_step=duration / samples, tolerance=1e-7
    )
    assert_peaks_bound(found, 0.1)


@pytest.mark.parametrize("periods", [0.3, 1.0, 2.4])
def test_peaks_of_driven_bodies_count_every_revolution(periods: float) -> None:
    speed = 20.0
    duration = periods * 2.0 * math.pi / speed
    for clearance in (5e-4, 0.0):
        found = run(
            "seven-bar-press",
            duration,
            parameters={**CASE_3, "speed": speed, "clearance": clearance},
            channels=["crank1.theta", "crank1.y"],
        )
        theta = found.peaks["crank1.theta"]
        assert (theta.minimum, theta.maximum) == pytest.approx((0.0, speed * duration), rel=1e-12)
        y = found.peaks["crank1.y"]
        arm = 0.0805445
        turned = speed * duration
        assert y.maximum == pytest.approx(
            arm * (1.0 if turned >= math.pi / 2 else math.sin(turned)), rel=1e-9
        )
        lowest = -1.0 if turned >= 1.5 * math.pi else min(0.0, math.sin(turned))
        assert y.minimum == pytest.approx(arm * lowest, rel=1e-9)
