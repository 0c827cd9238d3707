"""Stored steps give every channel at every time: the bits of samples, and extremes between them."""

from functools import cache
from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import METHOD, method_of, step_columns
from jointplay.solver.runs.dense_output.intervals import IntervalExtremes
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.results import Summary
from jointplay.solver.runs.simulate import Simulation
from tests.solver.knotted_scene import knotted_scene

PRESS = {"preset": "seven-bar-press"}
FINER = 37
SHARP = 1e-6
NOISE = 1e-7
"""Range, in SI units, that of the press's channels only one of nothing but rounding is below."""


def job(scene: dict[str, Any], duration: float, **more: Any) -> dict[str, Any]:
    fields = {"kind": "simulate", "scene": scene, "duration": duration, "certificate": False}
    return fields | {"output_step": duration / 50} | more


def computed(document: dict[str, Any]) -> tuple[Admission, Floats, Floats, Summary]:
    """Return a run's samples, and its steps with the method."""
    admission = admit(document)
    simulation = Simulation(admission)
    slices = list(simulation.slices())
    steps = np.concatenate([piece.steps for piece in slices])
    samples = np.concatenate([piece.samples for piece in slices])
    return admission, samples, steps, simulation.summary()


def replay_of(admission: Admission, steps: Floats) -> tuple[Replay, Floats]:
    (number,) = set(steps[:, -1])
    return Replay(admission, method_of(number)), np.ascontiguousarray(steps[:, :-1])


def moments_of(admission: Admission) -> Floats:
    count, step = admission.samples, admission.job["output_step"]
    moments = np.column_stack([np.arange(count, dtype=np.float64), np.full(count, step)])
    moments[-1] = admission.job["duration"], 1.0
    return moments


LONG = pytest.mark.long
CASES = [
    pytest.param(PRESS, 0.06, {}, id="press"),
    pytest.param(PRESS, 0.02, {"method": "rodas"}, id="press, implicit"),
    pytest.param({"preset": "bouncing-journal"}, 0.1, {}, id="journal"),
    pytest.param(knotted_scene(), 0.6, {"method": "tsitouras"}, id="knots"),
    pytest.param(PRESS, 0.05, {"accuracy": "draft"}, id="press, draft", marks=LONG),
    pytest.param(PRESS, 0.05, {"tolerance": 1e-11}, id="press, fine", marks=LONG),
    pytest.param(PRESS, 0.02, {"formulation": "lagrange"}, id="press, lagrange", marks=LONG),
    pytest.param(PRESS, 0.02, {"method": "rk4", "step": 2e-6}, id="press, fixed", marks=LONG),
    *(
        pytest.param({"preset": name}, duration, more, id=f"{name} {more}", marks=LONG)
        for name, duration in {
            "slider-crank": 0.5,
            "four-bar": 0.5,
            "andrews-squeezer": 0.02,
            "jansen-leg": 0.5,
            "double-four-bar": 0.5,
            "driven-pendulum": 9.0,
            "impact-oscillator": 3.0,
            "quick-return": 0.5,
            "double-pendulum": 1.0,
        }.items()
        for more in ({}, {"method": "rodas"}, {"method": "dormand-prince-853"})
    ),
]


@pytest.mark.parametrize(("scene", "duration", "more"), CASES)
def test_steps_give_the_bits_that_a_finer_grid_samples(
    scene: dict[str, Any], duration: float, more: dict[str, Any]
) -> None:
    admission, _, steps, _ = computed(job(scene, duration, **more))
    fine, expected, _, _ = computed(job(scene, duration, output_step=duration / 50 / FINER, **more))
    replay, rows = replay_of(admission, steps)
    names = [channel.name for channel in fine.channels]
    found = replay.channels(names, rows, moments_of(fine))
    assert found.shape == expected.shape
    assert np.array_equal(found.view(np.int64), expected.view(np.int64))


@cache
def press() -> tuple[Replay, Floats, list[str], Floats]:
    admission, _, steps, summary = computed(job(PRESS, 0.12))
    names = [channel.name for channel in admission.channels]
    ranges = np.array([summary.peaks[n].maximum - summary.peaks[n].minimum for n in names])
    return *replay_of(admission, steps), names, ranges


def test_extremes_of_the_whole_are_those_of_the_run() -> None:
    replay, steps, names, ranges = press()
    summary = computed(job(PRESS, 0.12))[-1]
    (found,) = replay.extremes(names, steps, np.array([0.0, 0.12]), ranges)
    real = ranges > NOISE
    for column in (0, 2):
        field = "minimum" if column == 0 else "maximum"
        expected = np.array([getattr(summary.peaks[name], field) for name in names])
        assert np.all(np.abs(found[:, column] - expected)[real] <= SHARP * ranges[real])


def test_a_window_cut_into_bins_has_the_extremes_of_the_whole_window() -> None:
    replay, steps, names, ranges = press()
    bins = replay.extremes(names, steps, np.linspace(0.01, 0.1, 301), ranges)
    (whole,) = replay.extremes(names, steps, np.array([0.01, 0.1]), ranges)
    assert np.all(np.abs(bins[:, :, 2].max(axis=0) - whole[:, 2]) <= SHARP * ranges + 1e-9)
    assert np.all(np.abs(bins[:, :, 0].min(axis=0) - whole[:, 0]) <= SHARP * ranges + 1e-9)


def alone_and_together(
    replay: Replay, steps: Floats, names: list[str], ranges: Floats, edges: Floats
) -> None:
    for evaluated in (True, False):
        together = replay.extremes(names, steps, edges, ranges, evaluated=evaluated)
        for c in range(len(names)):
            one = slice(c, c + 1)
            alone = replay.extremes(names[one], steps, edges, ranges[one], evaluated=evaluated)
            assert np.array_equal(alone[:, 0], together[:, c], equal_nan=True), names[c]


def test_extremes_of_a_channel_do_not_depend_on_what_is_asked_with_it() -> None:
    alone_and_together(*press(), np.linspace(0.01, 0.06, 41))


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "duration"),
    [
        ("slider-crank", 0.05),  # its torque is rounding at times, of a large range
        ("four-bar", 0.05),
        ("bouncing-journal", 0.5),
        ("double-pendulum", 1.0),
    ],
)
def test_extremes_of_a_channel_are_its_own_in_other_mechanisms(name: str, duration: float) -> None:
    admission, _, rows, summary = computed(job({"preset": name}, duration))
    names = [channel.name for channel in admission.channels]
    ranges = np.array([summary.peaks[n].maximum - summary.peaks[n].minimum for n in names])
    edges = np.linspace(0.3 * duration, 0.9 * duration, 41)
    alone_and_together(*replay_of(admission, rows), names, ranges, edges)


def test_intervals_between_samples_are_those_of_a_window() -> None:
    """Within 1e-6 of the range, and so of channels that are nothing but rounding."""
    replay, steps, names, ranges = press()
    admission = admit(job(PRESS, 0.12, steps_limit=0))
    assert isinstance(admission, Admission)
    intervals = IntervalExtremes(admission, "tsitouras")
    found = np.concatenate(
        [intervals.add(steps[:300]), intervals.add(steps[300:]), intervals.end()]
    )
    edges = np.append(np.arange(50) * admission.job["output_step"], 0.12)
    expected = replay.extremes(names, steps, edges, ranges)
    assert np.array_equal(found[:, 0], np.arange(1, 51))
    rounded = np.where(ranges > NOISE, SHARP * ranges, ranges)
    for column, first in ((0, 1), (2, 2)):
        assert np.all(np.abs(found[:, first::2] - expected[:, :, column]) <= rounded)


def test_steps_follow_one_another_from_the_start_to_the_end() -> None:
    replay, steps, _, _ = press()
    begins, ends = replay.begins(steps), replay.ends(steps)
    assert begins[0] == 0.0
    assert np.allclose(begins[1:], ends[:-1], rtol=0.0, atol=1e-16)
    assert ends[-1] == pytest.approx(0.12, abs=1e-15)


def test_a_run_keeps_no_more_steps_than_its_limit_and_the_first_ones() -> None:
    admission, samples, whole, _ = computed(job(PRESS, 0.06))
    columns = step_columns(admission)
    assert columns[-1] == METHOD
    assert whole.shape[1] == len(columns)
    limited, same, kept, _ = computed(job(PRESS, 0.06, steps_limit=8 * len(columns) * 100 + 7))
    assert np.array_equal(kept, whole[:100])
    assert np.array_equal(same, samples)
    none, again, nothing, _ = computed(job(PRESS, 0.06, steps_limit=0))
    assert step_columns(none) == ()
    assert nothing.size == 0
    assert np.array_equal(again, samples)
    assert limited.samples == none.samples


def test_every_method_has_a_number_of_its_own() -> None:
    assert sorted(method_of(float(k)) for k in range(len(METHODS))) == sorted(METHODS)
