"""Extremes of a run: each is reached at its own time, and none falls short of a sample."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.sampled_extremes import PROMISED, ROUNDING, SampledExtremes
from jointplay.solver.runs.simulate import Simulation

NOISE = 1e-9
"""Error allowed of channels that are nothing but rounding, in SI units."""
LONG = pytest.mark.long
Made = tuple[Admission, Simulation, Floats]
"""A job, its run and its steps, (steps, columns)."""


def computed(name: str, duration: float, **more: Any) -> Made:
    fields = {"kind": "simulate", "scene": {"preset": name}, "certificate": False}
    admission = admit(fields | {"duration": duration} | more)
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    return admission, simulation, np.concatenate([one.steps for one in simulation.slices()])


@pytest.mark.parametrize(
    ("name", "duration"),
    [
        ("impact-oscillator", 0.7),  # its slip is nothing: it has no row among those with records
        ("bouncing-journal", 0.1),
        pytest.param("seven-bar-press", 0.1, marks=LONG),
        pytest.param("slider-crank", 0.05, marks=LONG),
        pytest.param("double-pendulum", 1.0, marks=LONG),
        pytest.param("andrews-squeezer", 0.03, marks=LONG),
        pytest.param("jansen-leg", 0.5, marks=LONG),
        pytest.param("quick-return", 0.5, marks=LONG),
        pytest.param("driven-pendulum", 3.0, marks=LONG),
        pytest.param("seven-bar-press-punching", 0.1, marks=LONG),
    ],
)
def test_each_extreme_is_reached_at_its_own_time(name: str, duration: float) -> None:
    admission, simulation, rows = computed(name, duration)
    peaks = simulation.summary().peaks
    replay = Replay(admission, method_of(rows[0, -1]))
    steps = np.ascontiguousarray(rows[:, :-1])
    for kind in ("minimum", "maximum"):
        times = np.array([getattr(peak, f"{kind}_time") for peak in peaks.values()])
        order = np.argsort(times, kind="stable")
        moments = np.column_stack([times[order], np.ones_like(times)])
        found = replay.channels(list(peaks), steps, moments)[np.argsort(order), range(len(order))]
        said = np.array([getattr(peak, kind) for peak in peaks.values()])
        ranges = np.array([peak.maximum - peak.minimum for peak in peaks.values()])
        # a time is stored to 1e-16 of the run: a kink rises by its slope times that
        wrong = np.abs(found - said) > PROMISED * ranges + NOISE
        assert not wrong.any(), [name for name, bad in zip(peaks, wrong, strict=True) if bad]


def test_each_extreme_has_a_time_though_it_be_of_rounding() -> None:
    """A torque that nothing asks for turns wherever one looks, until all looks are one instant."""
    scene = {
        "preset": "slider-crank",
        "parameters": {"clearance": 4.0770360982e-4, "bearing_radius": 9.934760224481963e-3}
        | {"speed": 38.3930682603, "stiffness": 5.36249859435e8}
        | {"restitution": 0.271393467809, "friction": 0.130142509872}
        | {"dynamic_velocity": 8.90946003054e-5, "static_velocity": 4.45473001527e-5},
    }
    duration = 0.003046419970303412
    peaks = computed("", duration, scene=scene, tolerance=3.33248e-8)[1].summary().peaks
    times = [time for peak in peaks.values() for time in (peak.minimum_time, peak.maximum_time)]
    assert all(0.0 <= time <= duration for time in times)


def test_extremes_have_the_same_bits_whatever_is_sampled() -> None:
    """At 26.8 ms a journal passes the centre of its bearing in a step that samples fall into."""
    scene = {"preset": "seven-bar-press", "parameters": {"clearance": 4e-4}}
    found = [
        computed("", 0.05, scene=scene, output_step=step)[1].summary().peaks
        for step in (1e-3, 1e-4, 0.05)
    ]
    assert found[0] == found[1] == found[2]


def test_no_sample_is_beyond_an_extreme_where_reactions_have_a_pole() -> None:
    """At 0.714 s all bars are in line: the reactions of the middle crank have no limit there."""
    _, simulation, _ = computed("double-four-bar", 0.75)
    samples = np.concatenate([one.samples for one in Simulation(simulation.admission).slices()])
    names = [channel.name for channel in simulation.admission.channels]
    peaks = simulation.summary().peaks
    assert samples[:, names.index("A0.force_x")].min() < -400.0
    widest = max(peak.maximum - peak.minimum for peak in peaks.values())
    for name, values in zip(names, samples.T, strict=True):
        allowed = PROMISED * np.ptp(values) + ROUNDING * widest
        assert peaks[name].minimum - allowed <= values.min(), name
        assert peaks[name].maximum + allowed >= values.max(), name


def test_samples_count_where_they_are_beyond_and_since_when_they_shall() -> None:
    time = np.linspace(0.0, 1.0, 11)
    samples = np.column_stack([time, -time, np.where(time == 0.1, 9.0, 0.0)])
    peaks = {"a": Peak(0.0, 0.0, 1.0, 1.0), "b": Peak(-0.5, 0.5, 0.0, 0.0)}
    peaks["c"] = Peak(0.0, 0.0, 0.0, 0.0)
    for cuts in ([0, 11], [0, 1, 2, 7, 11]):
        held = SampledExtremes(3, 0.0)
        for first, last in pairwise(cuts):
            held.add(time[first:last], samples[first:last])
        found = held.held_against(peaks)
        assert found["a"] == peaks["a"]
        assert found["b"] == Peak(-1.0, 1.0, 0.0, 0.0)
        assert found["c"] == Peak(0.0, 0.0, 9.0, 0.1)
        again = SampledExtremes(3, 0.0)
        again.restore(held.state("x"), "x")
        assert again.held_against(peaks) == found
    settled = SampledExtremes(3, 0.15)
    settled.add(time, samples)
    assert settled.held_against(peaks)["c"] == peaks["c"]
    assert SampledExtremes(3, 2.0).held_against(peaks) == peaks


def test_no_sample_is_beyond_an_extreme_where_every_other_step_swings() -> None:
    """Friction holds a joint in its steep ramp, and a rate rises and turns in every other step.

    The steps between show nothing of that: its highest value was 5e-5 of its range short.
    """
    scene = {
        "preset": "slider-crank",
        "parameters": {"clearance": 1.33507874722e-4, "bearing_radius": 3.225877993380881e-3}
        | {"speed": 136.302006795, "stiffness": 1.36569187065e11}
        | {"restitution": 0.306474745875, "friction": 0.370755906498}
        | {"dynamic_velocity": 2.15567275418e-4, "static_velocity": 2.15567275418e-5},
    }
    coarse = {"method": "bogacki-shampine", "tolerance": 5.88481e-5, "output_step": 5e-4}
    made, rate = computed("", 5.05e-4, scene=scene, **coarse), "P.eccentricity_rate_y"
    peak, samples = made[1].summary().peaks[rate], sampled(made, rate, 4.9e-4, 5.05e-4)
    assert samples.max() <= peak.maximum + PROMISED * (peak.maximum - peak.minimum)


def test_no_sample_is_beyond_an_extreme_where_stiff_oil_swings_inside_steps() -> None:
    """Ends of steps fall by 1e-3 rad/s^2, and inside each the acceleration swings by 0.04.

    One step in 256 was looked into: the lowest value was 1.6e-5 of its range short.
    """
    film = {"law": "long-bearing-film", "viscosity": 0.1, "boundary_layer": 5e-6} | {
        "stiffness": {"law": "power", "stiffness": 1e9, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": 0.6},
    }
    pin = {"radial_clearance": 1e-4, "bearing_radius": 0.012, "bearing_width": 0.06}
    coulomb = {"law": "modified-coulomb", "coefficient": 0.2} | {
        "static_velocity": 1e-3,
        "dynamic_velocity": 1e-2,
    }
    revolute = {"type": "revolute"}
    scene = {
        "name": "oiled-crank-pin",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "G": [0.0, 0.02]}},
        "bodies": {
            "crank": bar(0.1, 0.5),
            "rod": bar(0.3, 0.4),
            "slider": {"mass": 0.6, "inertia": 1e-3, "points": {"p": [0.01, 0.0]}},
        },
        "joints": {
            "O": revolute | {"bearing": "ground.O", "journal": "crank.a"},
            "A": revolute
            | {"bearing": "rod.a", "journal": "crank.b"}
            | {"clearance": {**pin, "contact": film, "friction": coulomb}},
            "B": revolute | {"bearing": "rod.b", "journal": "slider.p"},
            "G": {"type": "prismatic", "guide": "ground.G", "slider": "slider.p"}
            | {"axis": [-1.0, 0.0], "angle": 0.0},
        },
        "drivers": {"motor": {"joint": "O", "speed": 50.0, "position": 0.3}},
        "start": {"angles": {"rod": 0.1}},
    }
    duration, oiled = 0.1, {"method": "tsitouras", "tolerance": 1e-9, "output_step": 0.01}
    made = computed("", duration, scene=scene, **oiled)
    peak = made[1].summary().peaks["rod.alpha"]
    lowest = sampled(made, "rod.alpha", 0.08815, 0.0883).min()
    assert lowest >= peak.minimum - PROMISED * (peak.maximum - peak.minimum)


def test_no_sample_is_beyond_an_extreme_where_a_step_leaves_the_limit_of_stability() -> None:
    """Behind three rejected ones a step is four times as long, and slip overshoots inside it.

    Its late stages look alike: the highest rate was 9e-5 of its range short.
    """
    scene = {
        "preset": "slider-crank",
        "parameters": {"clearance": 1.2116055036e-4, "bearing_radius": 4.373078411708301e-4}
        | {"speed": 122.976678085, "stiffness": 1.22231595083e10}
        | {"restitution": 0.192998383661, "friction": 0.0970409863935}
        | {"dynamic_velocity": 2.66446434036e-5, "static_velocity": 1.33223217018e-5},
    }
    duration, fine = 0.004693530829114199, {"tolerance": 1.26641e-6, "output_step": 1e-4}
    made, rate = computed("", duration, scene=scene, **fine), "P.eccentricity_rate_y"
    peak, samples = made[1].summary().peaks[rate], sampled(made, rate, 5.92e-4, 5.932e-4)
    assert samples.max() <= peak.maximum + PROMISED * (peak.maximum - peak.minimum)


def sampled(
    made: tuple[Admission, Simulation, Floats], name: str, low: float, high: float
) -> Floats:
    """Return a channel of a run at 4001 instants, by its steps."""
    admission, _, rows = made
    times = np.linspace(low, high, 4001)
    replay, moments = (
        Replay(admission, method_of(rows[0, -1])),
        np.stack([times, times * 0.0 + 1.0], 1),
    )
    return replay.channels([name], np.ascontiguousarray(rows[:, :-1]), moments)[:, 0]


def bar(length: float, mass: float) -> dict[str, Any]:
    ends = {"a": [-0.5 * length, 0.0], "b": [0.5 * length, 0.0]}
    return {"mass": mass, "inertia": mass * length**2 / 12.0, "points": ends}
