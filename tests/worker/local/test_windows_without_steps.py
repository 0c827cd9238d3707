"""Runs that keep no steps, or not all: windows show every peak, as with steps."""

import numpy as np
import pytest

import jointplay
from jointplay import figures
from jointplay.figures import sampling
from jointplay.figures.kind import Selection
from jointplay.local.folder_job import results_in
from jointplay.records.resolution import Resolution
from jointplay.solver.kinds import admit
from jointplay.solver.runs.simulate import Simulation

FORCE = "A.normal_force"
JOB = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
SHARP, NOISE = 1e-6, 1e-7
LIMITS = {"none": 0, "some": 120_000}


@pytest.fixture(scope="module")
def jobs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    limits = {"all": {}} | {name: {"steps_limit": bytes_} for name, bytes_ in LIMITS.items()}
    return {
        name: jointplay.run(JOB | {"certificate": False} | more, output=folder / name)
        for name, more in limits.items()
    }


@pytest.fixture(scope="module")
def sources(jobs):
    return {name: results_in(job._folder) for name, job in jobs.items()}


def test_the_impacts_of_a_window_are_in_it_though_no_sample_is(jobs):
    assert jobs["none"].window(FORCE, 0.02, 0.06)[FORCE].max() < 150.0
    window = jobs["none"].window(FORCE, 0.02, 0.06, points=2000)
    assert window[FORCE].max() == pytest.approx(1821.3, abs=0.1)
    assert window.between_samples
    assert "no steps are kept" in window.note
    assert window.resolution == Resolution("intervals", 1e-3, 0.02)
    samples = jobs["none"].window(FORCE, 0.02, 0.06)
    assert samples.resolution == Resolution("samples", 1e-3)
    assert len(window.time) == 2 * 40  # spans of a millisecond, as samples are


@pytest.mark.parametrize("name", LIMITS)
def test_random_windows_have_the_extremes_that_steps_would_give(sources, name):
    whole, found = sources["all"].trajectory, sources[name].trajectory
    peaks = sources["all"].peaks()
    names = list(peaks)
    ranges = np.array([one.maximum - one.minimum for one in peaks.values()])
    real, step = ranges > NOISE, 1e-3
    random = np.random.default_rng(1)
    for _ in range(20):
        first, count = random.integers(0, 1800), random.integers(1, 200)
        edges = (first + np.array([0, count])) * step
        expected, seen = (one.extremes(names, edges).values[0] for one in (whole, found))
        for k in (0, 2):
            off = np.abs(expected[:, k] - seen[:, k])
            assert np.all(off[real] <= SHARP * ranges[real])
        assert np.all(np.abs(seen[real][:, [1, 3]] - edges.mean()) <= (0.5 * count + 1.0) * step)


def test_peaks_of_a_window_and_curves_know_what_is_between_samples(jobs, sources):
    assert jobs["none"].results.peaks(0.02, 0.06)[FORCE].maximum == pytest.approx(1821.3, abs=0.1)
    peak = sources["none"].peaks()[FORCE]
    for source in sources.values():
        time, force, made_of = sampling.named_over_time(source, FORCE, Selection())
        assert made_of == sampling.TRAJECTORY
        assert np.all(np.diff(time) >= 0.0)
        best = int(np.argmax(force))
        assert force[best] == pytest.approx(peak.maximum, rel=1e-6)
        assert time[best] == pytest.approx(peak.maximum_time, abs=1e-3)
        assert figures.render(source, "time-history", "svg", Selection(channels=(FORCE,)))


def intervals_of(document, restarts):
    """Return samples and intervals of a run that begins again at some of its slices."""
    simulation = Simulation(admit(document))
    pieces, running = [], True
    while running:
        running = False
        for piece in simulation.slices():
            pieces.append(piece)
            if len(pieces) in restarts:
                simulation, running = Simulation(admit(document), simulation.checkpoint()), True
                break
    return tuple(np.concatenate([getattr(p, f) for p in pieces]) for f in ("samples", "intervals"))


def test_intervals_do_not_depend_on_slices_restarts_or_the_certificate():
    document = JOB | {"duration": 20.0, "channels": ["A.*"], "certificate": False}
    for limit in (0, 2_000_000):
        plain = intervals_of(document | {"steps_limit": limit}, ())
        broken = intervals_of(document | {"steps_limit": limit}, (1, 2, 3))
        certified = intervals_of(document | {"steps_limit": limit, "certificate": True}, ())
        assert len(plain[1]) == 2000 if not limit else 0 < len(plain[1]) < 2000
        for other in (broken, certified):
            for one, same in zip(plain, other, strict=True):
                assert np.array_equal(one.view(np.int64), same.view(np.int64))
