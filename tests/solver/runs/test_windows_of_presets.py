"""Extremes of random windows: none of a much finer sampling is beyond them, in either way."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.kinds import admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation

SHARP = 1e-6
"""Share of a channel's range that windows promise."""
NOISE = 1e-7
"""Range, in SI units, that only channels of nothing but rounding are below."""
BINS, INSTANTS = 20, 500
LONG = pytest.mark.long
RUNS = [
    pytest.param("seven-bar-press", {}, 0.12, 10, id="press"),
    pytest.param("seven-bar-press", {"method": "rodas"}, 0.05, 20, id="press, rodas", marks=LONG),
    *(
        pytest.param(name, more, duration, 20, id=f"{name} {more}", marks=LONG)
        for name, duration in {
            "slider-crank": 0.05,
            "four-bar": 0.05,
            "bouncing-journal": 1.0,
            "impact-oscillator": 3.0,
            "double-pendulum": 2.0,
        }.items()
        for more in ({}, {"method": "dormand-prince-853"})
    ),
]


def windows(duration: float, count: int) -> list[Floats]:
    """Return edges of windows from a ten-thousandth of a run to all of it."""
    random = np.random.default_rng(7)
    found = []
    for _ in range(count):
        width = duration * 10.0 ** random.uniform(-4.0, 0.0)
        start = random.uniform(0.0, duration - width)
        found.append(np.linspace(start, start + width, BINS + 1))
    return found


@pytest.mark.parametrize(("name", "more", "duration", "count"), RUNS)
def test_no_instant_of_a_window_is_beyond_its_extremes(
    name: str, more: dict[str, Any], duration: float, count: int
) -> None:
    fields = {"kind": "simulate", "scene": {"preset": name}, "certificate": False}
    admission = admit(fields | {"duration": duration, "output_step": duration / 50} | more)
    simulation = Simulation(admission)
    rows = np.concatenate([piece.steps for piece in simulation.slices()])
    replay = Replay(admission, method_of(rows[0, -1]))
    steps, peaks = np.ascontiguousarray(rows[:, :-1]), simulation.summary().peaks
    ranges = np.array([peaks[n].maximum - peaks[n].minimum for n in peaks])
    allowed = np.where(ranges > NOISE, SHARP * ranges, NOISE)
    for edges in windows(duration, count):
        times = np.linspace(edges[0], edges[-1], BINS * INSTANTS + 1)
        values = replay.channels(list(peaks), steps, np.column_stack([times, np.ones_like(times)]))
        bins = values[:-1].reshape(BINS, INSTANTS, -1)
        found, sharp = (
            replay.extremes(list(peaks), steps, edges, ranges, evaluated=evaluated)
            for evaluated in (True, False)
        )
        for extremes in (found, sharp):
            assert np.all(bins.max(axis=1) <= extremes[:, :, 2] + allowed)
            assert np.all(bins.min(axis=1) >= extremes[:, :, 0] - allowed)
        assert np.all(np.abs(found - sharp)[:, :, ::2] <= allowed[:, None])
