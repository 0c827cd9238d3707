"""Pictures and windows of a run in a folder: peaks that samples step over are at their places."""

from functools import partial

import numpy as np
import pytest

import jointplay
from jointplay import figures
from jointplay.client.errors import Refused
from jointplay.figures import between_samples, sampling
from jointplay.figures.bearing_angles import loads
from jointplay.figures.kind import Selection
from jointplay.local.folder_job import results_in
from jointplay.records.resolution import Resolution
from jointplay.records.run import inside
from jointplay.worker.windows import trajectory
from jointplay.worker.windows.evaluate import answer
from jointplay.worker.windows.question import Question

FORCE = "A.normal_force"
ROUNDING = 1e-7
"""Range, in SI units, that only channels of nothing but rounding are below."""
PRESS = {"preset": "seven-bar-press"}


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    """A press whose samples are 4 ms apart: ten impacts."""
    document = {"kind": "simulate", "scene": PRESS, "duration": 0.06, "output_step": 0.004}
    folder = tmp_path_factory.mktemp("runs") / "OUT"
    return jointplay.run(document | {"certificate": False}, output=folder)


@pytest.fixture
def source(job):
    return results_in(job._folder)


@pytest.fixture
def peak(source):
    return source.peaks()[FORCE]


def test_a_curve_passes_through_every_peak_at_its_place(source, peak):
    time, force = sampling.over_time(source, FORCE, Selection())
    assert np.all(np.diff(time) >= 0.0)
    best = int(np.argmax(force))
    assert force[best] == pytest.approx(peak.maximum, rel=1e-6)
    assert time[best] == pytest.approx(peak.maximum_time, abs=1e-9)
    impacts = sampling.impacts_of(source, "A")
    impacts = impacts[np.isfinite(impacts["release"])]
    assert len(impacts) > 3
    for one in impacts:
        seen = force[inside(time, one["onset"], one["release"])].max()
        assert seen == pytest.approx(one["peak_force"], rel=1e-5)


def test_no_impact_is_drawn_as_one_between_samples(source):
    with figures.page.style():
        (axes,) = figures.draw(source, "contact-force").axes[:1]
    lines = [found for found in axes.collections if found.get_label().startswith("impacts")]
    assert [len(one.get_segments()) for one in lines] == [0]


def test_a_path_is_as_close_together_as_the_steps(source, peak):
    names = ("A.penetration", FORCE)
    time, values = sampling.in_a_plane(source, names, Selection())
    assert len(time) > 10 * source.samples
    assert values[FORCE].max() == pytest.approx(peak.maximum, rel=0.01)
    bent = sampling.path(source, "A", ("A.eccentricity_x", "A.eccentricity_y"), Selection())
    assert len(bent[0]) == len(time)


def test_the_loop_of_one_impact_is_drawn_whatever_the_samples(source):
    assert figures.render(source, "impact-loop", "svg")[:5] == b"<?xml"


def test_a_spectrum_of_forces_reaches_beyond_what_samples_resolve(source):
    with figures.page.style():
        drawn = figures.draw(source, "spectrum", Selection(channels=(FORCE,)))
    (line, *_) = drawn.axes[0].lines
    assert line.get_xdata().max() > 1e4
    assert not any("change faster" in text.get_text() for text in drawn.texts)


def test_the_balance_of_energy_ends_where_the_ledger_does(source):
    axes = figures.draw(source, "energy").axes[0]
    curves = [
        line for line in axes.lines if line.get_marker() == "None" and line.get_label()[0] != "_"
    ]
    rings = [line for line in axes.lines if line.get_marker() == "o"]
    largest = max(np.abs(curve.get_ydata()).max() for curve in curves)
    assert len(rings) == len(curves) == 4
    for curve, ring in zip(curves, rings, strict=True):
        assert curve.get_ydata()[-1] == pytest.approx(ring.get_ydata()[0], abs=1e-3 * largest)


def test_a_rose_holds_the_impulse_of_all_contacts(source):
    whole = loads(source, "A", Selection(), 36).mean.sum() * source.trajectory.reached
    impacts = sampling.impacts_of(source, "A")
    ended = impacts[np.isfinite(impacts["release"])]
    assert whole == pytest.approx(ended["impulse"].sum(), rel=0.02)


def test_windows_of_a_folder_are_those_of_a_service(job, peak):
    window = job.window(FORCE, points=100)
    assert window.between_samples
    assert window.resolution == Resolution("steps")
    assert window[FORCE].max() == pytest.approx(peak.maximum, rel=1e-6)
    fine = job.window(FORCE, 0.02, 0.021, step=1e-6)
    assert len(fine.time) == 1001
    found = job.results.peaks(0.0, 0.03)[FORCE]
    assert found.maximum <= peak.maximum * (1.0 + 1e-9)


@pytest.mark.parametrize(
    ("start", "stop", "end"), [(0.03, 0.01, "stop"), (None, -1.0, "stop"), (0.07, None, "start")]
)
def test_a_window_that_the_run_does_not_have_is_refused(job, start, stop, end):
    for ask in (job.results.peaks, partial(job.window, FORCE, step=1e-3)):
        with pytest.raises(Refused) as refused:
            ask(start=start, stop=stop)
        assert [one.pointer for one in refused.value.fields] == [end]


def test_a_long_window_is_read_in_pieces_with_the_same_result(source, monkeypatch):
    names = [FORCE, "slider7.x", "crank1.theta"]
    edges, times = np.linspace(0.0, 0.06, 41), np.linspace(0.0, 0.06, 777)
    whole = source.trajectory.extremes(names, edges), source.trajectory.values(names, times)
    monkeypatch.setattr(trajectory, "AT_ONCE", 150)
    extremes, values = (
        source.trajectory.extremes(names, edges),
        source.trajectory.values(names, times),
    )
    assert np.array_equal(values.values, whole[1].values)
    close = np.abs(extremes.values - whole[0].values)[:, :, ::2].max(axis=(0, 1))
    assert np.all(close <= 1e-6 * 2186.0)
    assert np.all(np.diff(extremes.values[:, 0, 3]) > 0.0)
    monkeypatch.setattr(trajectory, "MOST_PIECES", 2)
    assert "A shorter one is exact" in source.trajectory.extremes(names, edges).refused


def test_a_window_of_many_steps_and_all_channels_has_every_extreme(source, monkeypatch):
    peaks = source.peaks()
    ranges = np.array([one.maximum - one.minimum for one in peaks.values()])
    edges, names = np.linspace(0.0, 0.06, 31), list(peaks)
    whole = source.trajectory.extremes(names, edges)
    monkeypatch.setattr(trajectory, "AT_ONCE", 600)
    pieces = source.trajectory.extremes(names, edges)
    assert pieces.resolution == whole.resolution == Resolution("steps")
    off = np.abs(pieces.values - whole.values)[:, :, ::2].max(axis=(0, 2))
    real = ranges > ROUNDING
    assert np.all(off[real] <= 1e-6 * ranges[real])
    alone = source.trajectory.extremes([FORCE], edges)
    assert np.array_equal(alone.values[:, 0], pieces.values[:, names.index(FORCE)])


def asked(source, change):
    """Return the answer to a question whose steps were changed, as by another machine."""
    steps = source.steps.read(0, source.steps.count)
    change(steps)
    attributes = source.attributes
    methods, edges = tuple(attributes["methods"]), np.linspace(0.0, 0.06, 101)
    return answer(Question(attributes["job"], (FORCE,), steps, edges=edges, methods=methods))


def test_steps_of_another_machine_are_read_and_said_to_be_and_others_are_refused(source):
    speed = source.steps.columns.index("link2.theta")

    def rounded(steps):
        steps[1:, speed] *= 1.0 + 1e-15

    def of_another_scene(steps):
        steps[:, speed] += 0.01 * np.arange(len(steps))

    def of_no_method(steps):
        steps[:, -1] = 77.0

    assert not asked(source, lambda steps: None).rounded
    found = asked(source, rounded)
    assert found.rounded
    assert found.values is not None
    assert "other steps" in asked(source, of_another_scene).refused
    assert "no method" in asked(source, of_no_method).refused


def test_a_curve_of_too_many_steps_is_of_samples(job, source, monkeypatch):
    monkeypatch.setattr(trajectory, "AT_ONCE", 10)
    assert between_samples.curve(source, FORCE, Selection()) is None
    time, _, label = sampling.named_over_time(source, FORCE, Selection())
    assert len(time) == source.samples
    assert label == "samples"
    window = job.window(FORCE, points=1000)
    assert "A shorter one is exact" in window.note
    assert window.exact
    assert window.resolution == Resolution("samples", 0.004)
    overview = job.window(FORCE, points=8)
    assert not overview.exact
    assert not overview.between_samples
    found = overview[FORCE].max()  # contacts are known anyway
    assert found == pytest.approx(source.peaks()[FORCE].maximum, rel=1e-6)


def test_a_loop_shows_the_impact_with_which_a_long_contact_begins(tmp_path):
    """A block falls on the floor of its guide, bounces less than it sinks in, and is lifted off."""
    body = {"mass": 1.0, "inertia": 1.0, "points": {"P": [0.0, 0.0]}}
    contact = {"law": "stiffness-and-dissipation", "dissipation": {"law": "exact"}}
    contact["stiffness"] = {"law": "power", "stiffness": 1e9, "exponent": 1.5}
    contact["dissipation"]["restitution"] = 0.1
    play = {"wall_clearance": 1e-3, "pin_radius": 0.01, "contact": contact}
    course = {"type": "table", "knots": [0.0, 0.4, 0.5], "values": [-1.0, -1.0, 1.0]}
    upward = {"type": "prismatic", "guide": "ground.O", "slider": "block.P", "axis": [0.0, 1.0]}
    floor = {"type": "pin-in-slot", "slot": "ground.O", "pin": "block.P", "axis": [1.0, 0.0]}
    scene = {
        "name": "block",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"block": body},
        "joints": {"upward": upward, "floor": floor | {"clearance": play}},
        "forces": {
            "lift": {
                "type": "force", "first": "ground.O", "second": "block.P",
                "direction": [0.0, 1.0], "magnitude": 50.0, "course": course | {"outside": "held"},
            }
        },
    }  # fmt: skip
    job = jointplay.run(
        {"kind": "simulate", "scene": scene, "duration": 0.6, "certificate": False},
        output=tmp_path / "OUT",
    )
    source = results_in(job._folder)
    (one,) = [r for r in sampling.impacts_of(source, "floor.wall_2") if r["release"] > 0.4]
    assert one["onset"] < 0.1
    with figures.page.style():
        (axes,) = figures.draw(source, "impact-loop").axes[:1]
    drawn = max(line.get_ydata().max() for line in axes.lines)
    assert drawn == pytest.approx(one["peak_force"], rel=1e-3)
    rests = (50.0 / 1e9) ** (2.0 / 3.0)  # m, where the floor carries 50 N
    lost = (
        50.0 * (1e-3 + rests) - 0.4 * 50.0 * rests
    )  # J: fallen through, less what the floor gives back
    assert f"{1e3 * lost:.3g} mJ dissipated" in axes.get_title(loc="left")
