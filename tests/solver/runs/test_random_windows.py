"""Random windows of random runs: their largest value is that of a sampling at a microsecond.

A sampling misses what is sharper than it: an extreme of a window may lie beyond it, and is then
evaluated where it is said to be.
"""

from functools import cache
from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation

WINDOWS, POINTS = 5, 2000
MOST_SAMPLES = 20_000
SHARP = 1e-6
ROUNDING = 1e-7
"""Range, in SI units, that only a channel of nothing but rounding is below."""
DURATIONS = {"seven-bar-press": 0.3, "slider-crank": 0.03, "bouncing-journal": 0.3}
METHODS = ({}, {"tolerance": 1e-9}, {"accuracy": "draft"}, {"method": "rodas"})


def drawn_job(seed: int) -> dict[str, Any]:
    """Return a job of a preset with clearance, friction and restitution drawn at random."""
    random = np.random.default_rng(seed)
    name = list(DURATIONS)[seed % len(DURATIONS)]
    parameters = {
        "clearance": float(10.0 ** random.uniform(-4.3, -3.0)),
        "friction": float(random.choice([0.0, 0.01, 0.1])),
        "restitution": float(random.uniform(0.5, 0.95)),
    }
    fields = {"kind": "simulate", "scene": {"preset": name, "parameters": parameters}}
    more: dict[str, Any] = METHODS[seed // len(DURATIONS) % len(METHODS)]
    return fields | {"duration": DURATIONS[name], "certificate": False} | more


@cache
def run_of(seed: int) -> tuple[Replay, Floats, list[str], Floats]:
    admission = admit(drawn_job(seed))
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    steps = np.concatenate([piece.steps for piece in simulation.slices()])
    peaks = simulation.summary().peaks
    ranges = np.array([one.maximum - one.minimum for one in peaks.values()])
    replay = Replay(admission, method_of(steps[0, -1]))
    return replay, np.ascontiguousarray(steps[:, :-1]), list(peaks), ranges


def at(replay: Replay, names: list[str], steps: Floats, times: Floats) -> Floats:
    return replay.channels(names, steps, np.column_stack([times, np.ones(len(times))]))


SHORT = (0,)
SEEDS = [s if s in SHORT else pytest.param(s, marks=pytest.mark.long) for s in range(20)]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_largest_of_a_window_is_that_of_a_sampling_at_a_microsecond(seed: int) -> None:
    replay, steps, names, ranges = run_of(seed)
    random = np.random.default_rng(1000 + seed)
    end = float(replay.ends(steps)[-1])
    real = ranges > ROUNDING
    for _ in range(WINDOWS):
        width = min(end * 10.0 ** random.uniform(-3.0, -0.3), 1e-6 * MOST_SAMPLES)
        start = random.uniform(0.0, end - width)
        edges = np.linspace(start, start + width, POINTS + 1)
        bins = replay.extremes(names, steps, edges, ranges)
        samples = at(replay, names, steps, np.arange(start, start + width, 1e-6))
        for column, sense in ((0, -1.0), (2, 1.0)):
            best = (sense * bins[:, :, column]).argmax(axis=0)
            found = bins[best, np.arange(len(names)), column]
            times = bins[best, np.arange(len(names)), column + 1]
            short = (sense * samples).max(axis=0) - sense * found
            assert np.all(short[real] <= SHARP * ranges[real])
            order = np.argsort(times)
            there = at(replay, names, steps, np.clip(times[order], start, start + width))
            off = np.abs(there[np.arange(len(names)), order] - found[order])
            assert np.all(off[real[order]] <= SHARP * ranges[order][real[order]])
