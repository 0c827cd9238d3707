"""Peaks of simulations that leave out settling: those of the rest, and nothing else changes."""

from dataclasses import astuple
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation

PRESS = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.12}
IDEAL = {"scene": {"preset": "slider-crank", "parameters": {"clearance": 0.0}}}
SETTLE = 0.0317
"""Inside a step, between samples, and behind the first impacts, the strongest of all, s."""
SHARP = 1e-6
"""Share of a channel's range to which the extremes of runs and of their steps are sharp."""


def run(restarts: tuple[int, ...] = (), **more: Any) -> tuple[Admission, Simulation, list[Any]]:
    """Return a run that begins again from its checkpoint at some of its slices."""
    admission = admit(PRESS | {"certificate": False} | more)
    simulation, pieces = Simulation(admission), []
    running = True
    while running:
        running = False
        for piece in simulation.slices():
            pieces.append(piece)
            if len(pieces) in restarts:
                simulation, running = Simulation(admission, simulation.checkpoint()), True
                break
    return admission, simulation, pieces


def table(simulation: Simulation) -> np.ndarray:
    return np.array([astuple(peak) for peak in simulation.summary().peaks.values()])


def test_peaks_are_those_of_the_steps_after_settling() -> None:
    admission, simulation, pieces = run(settle=SETTLE)
    rows = np.concatenate([piece.steps for piece in pieces])
    names = [channel.name for channel in admission.channels]
    replay = Replay(admission, method_of(rows[0, -1]))
    steps = np.ascontiguousarray(rows[:, :-1])
    (expected,) = replay.extremes(names, steps, np.array([SETTLE, 0.12]), np.zeros(len(names)))
    found = table(simulation)
    ranges = expected[:, 2] - expected[:, 0]
    for column in (0, 2):
        assert np.all(np.abs(found - expected)[:, column] <= SHARP * ranges)
        assert np.all(found[:, column + 1] >= SETTLE)
    force = names.index("A.normal_force")
    assert found[force, 2] < 0.9 * table(run()[1])[force, 2]


def test_trajectory_digest_and_peaks_of_whole_runs_are_as_without_settling() -> None:
    (plain, whole, before), (zero, same, _) = run(), run(settle=0.0)
    settled, _, after = run(settle=SETTLE)
    assert plain.digest == zero.digest != settled.digest
    assert np.array_equal(table(whole), table(same))
    for name in ("samples", "sections", "impacts", "steps"):
        one, other = (np.concatenate([getattr(p, name) for p in ps]) for ps in (before, after))
        assert one.tobytes() == other.tobytes()


def test_peaks_do_not_depend_on_slices_kept_steps_or_the_certificate() -> None:
    more = {"settle": 0.5, "duration": 10.0, "channels": ["A.*"]}
    expected = table(run(**more)[1])
    for other in (run((1, 2, 3), **more), run(steps_limit=0, **more)):
        assert table(other[1]).tobytes() == expected.tobytes()


def test_nothing_is_told_of_peaks_before_the_motion_has_settled() -> None:
    simulation = Simulation(admit(PRESS | {"certificate": False, "duration": 20.0, "settle": 19.0}))
    assert next(iter(simulation.slices())).time < 19.0
    assert simulation.summary().peaks == {}


@pytest.mark.parametrize("turns", [2.2, 0.7])
def test_an_ideal_mechanism_has_the_extremes_of_the_rest(turns: float) -> None:
    period = admit(PRESS | IDEAL).period or 0.0
    settle = 0.3 * period
    more = IDEAL | {"duration": turns * period, "settle": settle}
    admission, simulation, pieces = run(**more)
    samples = np.concatenate([piece.samples for piece in pieces])
    times = np.concatenate([piece.sample_time for piece in pieces])
    shown, found = samples[times >= settle], table(simulation)
    ranges = np.ptp(shown, axis=0) + 1e-12
    assert np.all(found[:, 0] <= shown.min(axis=0) + 1e-9 * ranges)
    assert np.all(found[:, 2] >= shown.max(axis=0) - 1e-9 * ranges)
    # samples are 1/2000 of the duration apart: at a smooth extreme they miss little
    assert np.all(np.abs(found[:, 0] - shown.min(axis=0)) <= 1e-3 * ranges)
    assert np.all(np.abs(found[:, 2] - shown.max(axis=0)) <= 1e-3 * ranges)
    assert found[:, [1, 3]].min() >= settle * (1.0 - 1e-12)
    assert len(admission.channels) == len(found)


@pytest.mark.parametrize("settle", [0.12, 1.0])
def test_settling_for_all_of_a_run_is_refused(settle: float) -> None:
    with pytest.raises(InvalidInput) as refused:
        admit(PRESS | {"settle": settle})
    ((pointer, sentence),) = refused.value.problems
    assert pointer == "/settle"
    assert "must be shorter" in sentence
