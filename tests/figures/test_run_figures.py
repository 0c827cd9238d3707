"""Figures of runs: what they show, and what they refuse."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from closed_form_motion import CLEARANCES, POSE, SCENE, closed_form_motion
from drawn import drawn_with
from matplotlib.colors import to_hex
from test_every_figure import CHOICES

from jointplay import figures
from jointplay.figures import NotDrawable, Selection, UnknownFigure, colours, page
from jointplay.figures.kind import select
from jointplay.figures.mechanism_marks import EDGE, TINTS
from jointplay.figures.sampling import extremes
from jointplay.records.channel import Channel
from jointplay.records.peak import Peak
from jointplay.records.run import Dataset
from tests.sampled import sampled


@pytest.fixture(scope="module")
def motion():
    return closed_form_motion()


@pytest.fixture(params=figures.RUN_FIGURES)
def name(request):
    return request.param


def drawn(motion, name):
    """The figure, laid out as it is saved."""
    return drawn_with(motion, name, CHOICES.get(name))


def test_its_colours_are_told_apart_with_any_colour_vision(motion, name):
    chosen = {colours.COMPUTED, colours.MARKED, colours.GEOMETRY, colours.AUXILIARY, EDGE, *TINTS}
    chosen |= {colour for colour, _, _ in colours.COMPARED}
    for axes in drawn(motion, name).axes:
        seen = {to_hex(line.get_color()).upper() for line in axes.lines}
        assert seen <= chosen


def test_a_channel_that_was_not_stored_is_named(motion, name):
    lost = figures.required(motion, name, CHOICES.get(name))[-1]
    channels = [channel for channel in motion.channels if channel.name != lost]
    if name in ("outputs", "spectrum", "histogram", "certificate"):  # draw those that there are
        assert lost not in figures.required(replace(motion, channels=channels), name)
        return
    with pytest.raises(NotDrawable, match=lost.replace(".", r"\.")):
        figures.draw(replace(motion, channels=channels), name, CHOICES.get(name))
    assert name not in [
        listed.name for listed in figures.available(replace(motion, channels=channels))
    ]


def test_a_window_without_samples_is_refused(motion, name):
    nothing = replace(CHOICES.get(name, Selection()), start=5.0)
    with pytest.raises(NotDrawable, match="no samples in this window"):
        figures.draw(motion, name, nothing)


def test_one_sample_is_drawn(name):
    assert_short_is_drawn(name, 1)


@pytest.mark.parametrize("name", sampled(figures.RUN_FIGURES, 4))
def test_two_samples_are_drawn(name):
    assert_short_is_drawn(name, 2)


def assert_short_is_drawn(name, samples):
    short = closed_form_motion(samples=samples, periods=0)
    if name == "impact-loop":
        with pytest.raises(NotDrawable, match=r"output_step of 0\.\d+ s"):
            figures.draw(short, name)
        return
    assert drawn(short, name).axes


@pytest.mark.parametrize("name", sampled(figures.RUN_FIGURES, 5))
def test_values_that_were_not_computed_leave_a_gap(motion, name):
    values = {key: np.where(motion.time > 1.0, np.nan, v) for key, v in motion.values.items()}
    assert figures.render(replace(motion, values=values), name, "png", CHOICES.get(name))


@pytest.fixture(scope="module")
def long_history():
    return closed_form_motion(samples=200_000, periods=30_000)


@pytest.mark.parametrize("name", sampled(figures.RUN_FIGURES, 4))
def test_a_long_history_makes_no_large_file(long_history, name):
    assert len(figures.render(long_history, name, "svg", CHOICES.get(name))) < 1_500_000


def test_importing_the_family_loads_neither_matplotlib_nor_the_solver():
    code = (
        "import sys, jointplay.figures, jointplay.exports.run;"
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert not {"matplotlib", "zarr", "numba", "solver", "storage"} & set(found.stdout.split())


def test_drawing_does_not_load_pyplot():
    code = (
        "import sys; sys.path.insert(0, 'tests/figures');"
        "from closed_form_motion import closed_form_motion;"
        "from jointplay import figures;"
        "figures.render(closed_form_motion(), 'orbit', 'png');"
        "print('matplotlib.pyplot' in sys.modules)"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "False"


def test_the_list_holds_what_can_be_drawn_and_the_declared_outputs(motion):
    names = [listed.name for listed in figures.available(motion)]
    expected = ["outputs", "contact-force", "orbit", "phase-portrait", "spectrum", "mechanism"]
    expected += ["animation", "force-rose", "impact-loop", "energy", "histogram", "certificate"]
    assert names == [*expected, "stroke", "pace"]
    assert all(listed.title for listed in figures.available(motion))
    for each in names:
        assert figures.required(motion, each)


def test_any_stored_channel_is_a_figure(motion):
    assert figures.required(motion, "left.normal_force") == ("left.normal_force",)
    assert figures.render(motion, "left.normal_force", "png")


def test_an_unknown_figure_is_refused_with_those_there_are(motion):
    with pytest.raises(UnknownFigure, match="outputs, contact-force, orbit"):
        figures.draw(motion, "spectra")


@pytest.mark.parametrize("each", ["contact-force", "orbit", "phase-portrait"])
def test_joints_are_chosen_by_name(motion, each):
    needed = figures.required(motion, each, Selection(joints=("right",)))
    assert needed
    assert all(channel.startswith("right.") for channel in needed)
    with pytest.raises(NotDrawable, match="those that do are left, right"):
        figures.draw(motion, each, Selection(joints=("closed",)))


@pytest.mark.parametrize(
    ("each", "selection", "cause"),
    [
        ("outputs", Selection(joints=("left",)), "joints"),
        ("orbit", Selection(channels=("stroke",)), "channels"),
        ("stroke", Selection(joints=("left",)), "joints"),
        ("stroke", Selection(channels=("pace",)), "channels"),
        ("phase-portrait", Selection(channels=("pace",), joints=("left",)), "joints"),
    ],
)
def test_a_choice_that_means_nothing_for_a_figure_is_refused(motion, each, selection, cause):
    with pytest.raises(NotDrawable) as caught:
        figures.draw(motion, each, selection)
    assert caught.value.cause == cause


@pytest.mark.parametrize("each", ["contact-force", "orbit", "phase-portrait"])
def test_a_scene_without_clearance_has_no_such_figure(motion, each):
    bare = replace(motion, joints=(), attributes={"scene": {**SCENE, "joints": {}}})
    with pytest.raises(NotDrawable, match="the scene has none"):
        figures.draw(bare, each)


def test_a_figure_of_journals_says_that_other_joints_are_none(motion):
    slot = {"type": "pin-in-slot", "clearance": {"wall_clearance": 1e-4, "pin_radius": 0.01}}
    other = replace(motion, attributes={"scene": {**SCENE, "joints": {"slot": slot}}})
    for selection in (Selection(), Selection(joints=("slot",))):
        with pytest.raises(NotDrawable, match="a revolute joint with clearance"):
            figures.draw(other, "orbit", selection)


def test_the_orbit_shows_each_clearance_to_scale(motion):
    for axes, clearance in zip(drawn(motion, "orbit").axes, CLEARANCES.values(), strict=True):
        (circle,) = [line for line in axes.lines if line.get_label() == "clearance circle"]
        x, y = circle.get_data()
        np.testing.assert_allclose(np.hypot(x, y), clearance * 1e3, rtol=1e-12)  # drawn in mm
        assert axes.get_aspect() == 1.0


def test_impacts_between_samples_are_drawn_as_high_as_they_were(motion):
    for index, axes in enumerate(drawn(motion, "contact-force").axes):
        (spikes,) = axes.collections
        tips = sorted(segment[1][1] for segment in spikes.get_segments())
        short = motion.contacts["release"] - motion.contacts["onset"] < 1e-3
        here = motion.contacts["joint"] == index
        expected = sorted(motion.contacts["peak_force"][here & short])
        np.testing.assert_allclose(tips, expected)


def test_a_long_history_keeps_its_extremes():
    motion = closed_form_motion(samples=100_001)
    values = dict(motion.values)
    values["stroke"] = values["stroke"].copy()
    values["stroke"][54_321] = 9.0  # one sample of a hundred thousand
    (axes,) = drawn(replace(motion, values=values), "stroke").axes
    time, shown = axes.lines[0].get_data()
    assert len(time) <= 4002
    assert shown.max() == 9.0
    assert time[shown.argmax()] == motion.time[54_321]


def test_ends_of_a_window_that_are_no_numbers_are_named(motion):
    for end in ("start", "stop"):
        with pytest.raises(NotDrawable, match=f"{end} is not a number") as refused:
            select(motion, **{end: float("nan")})
        assert refused.value.cause == end


def test_extremes_beside_what_is_not_known_are_kept_and_so_is_the_gap():
    time = np.arange(12.0)
    values = np.array([1.0, 5.0, np.nan, -3.0, 2.0, 1.0, 0.5, 4.0, np.nan, np.nan, np.nan, np.nan])
    kept, drawn = extremes(time, values, 4)
    assert kept.tolist() == [1.0, 2.0, 3.0, 6.0, 7.0, 8.0]
    np.testing.assert_array_equal(drawn, values[kept.astype(int)])


def test_extremes_that_no_sample_comes_near_are_marked(motion):
    def marked(selection=None):
        (axes,) = drawn_with(peaks, "stroke", selection).axes
        (marks,) = [line for line in axes.lines if line.get_label() == "extreme between samples"]
        return np.column_stack(marks.get_data()).tolist()

    low, high = motion.values["stroke"].min(), motion.values["stroke"].max()
    peaks = replace(motion, extremes={"stroke": Peak(low - 0.2, 0.3, high + 1e-5, 1.2)})
    assert marked() == [[0.3, low - 0.2]]  # the maximum is as good as on a sample
    assert marked(Selection(start=1.3)) == []


def test_the_phase_portrait_shows_every_section_of_the_window(motion):
    def points(selection):
        with page.style():
            (axes,) = figures.draw(motion, "phase-portrait", selection).axes
        (line,) = [line for line in axes.lines if line.get_label() == "Poincaré points"]
        return np.column_stack(line.get_data())

    pair = Selection(channels=("block.x", "block.vx"))
    sections = np.column_stack([motion.section_values[name] for name in pair.channels])
    np.testing.assert_array_equal(points(pair), sections)
    inside = (motion.section_time >= 0.5) & (motion.section_time <= 1.0)
    np.testing.assert_array_equal(points(replace(pair, start=0.5, stop=1.0)), sections[inside])


def test_a_phase_portrait_needs_two_channels(motion):
    with pytest.raises(NotDrawable, match="two channels"):
        figures.draw(motion, "phase-portrait", Selection(channels=("block.x",)))


def test_time_histories_are_bounded_in_number(motion):
    many = Selection(channels=tuple(channel.name for channel in motion.channels))
    with pytest.raises(NotDrawable, match="at most 8"):
        figures.draw(motion, "time-history", many)


def test_long_names_stay_beside_their_panels():
    time = np.linspace(0.0, 1.0, 100)
    values = {"angular_acceleration": 2e4 * time, "follower.angular_acceleration": -2e4 * time}
    channels = [Channel(name, "rad/s^2", name) for name in values]
    run = Dataset({"scene": {}}, channels, time, values)
    for axes in drawn_with(run, "time-history", Selection(channels=tuple(values))).axes:
        name = axes.yaxis.label.get_window_extent()
        assert axes.bbox.y0 <= name.y0 <= name.y1 <= axes.bbox.y1


def test_the_mechanism_is_drawn_where_its_pose_says():
    with page.style():
        (axes,) = figures.draw_mechanism(SCENE, POSE).axes
    names = {text.get_text(): text for text in axes.texts}
    assert {"crank", "plate", "block", "foot", "O", "left"} <= names.keys()
    with_play, others = names["right"], names["closed, weld, guide"]  # in one place
    assert with_play.xy == others.xy
    assert with_play.get_color() == colours.MARKED != others.get_color()
    rings = [line for line in axes.lines if line.get_label() == "joint with clearance"]
    (ring,) = rings
    # the crank's pin: 0.1 m from its centre, and the block's end, on its centre
    crank_x, crank_y, angle = POSE["crank"]
    pin = [crank_x + 0.1 * np.cos(angle), crank_y + 0.1 * np.sin(angle)]
    np.testing.assert_allclose(np.column_stack(ring.get_data()), [pin, POSE["block"][:2]])


def test_names_stay_inside_the_frame_beside_a_body_at_its_edge():
    bodies = {
        name: {"points": {"a": [-0.2, 0.0], "b": [0.2, 0.0]}}
        for name in ("left-hand rocker", "right-hand rocker")
    }
    upright = np.pi / 2.0
    pose = {"left-hand rocker": (0.0, 0.2, upright), "right-hand rocker": (0.5, 0.2, upright)}
    with page.style():
        figure = figures.draw_mechanism({"bodies": bodies, "joints": {}}, pose)
        figure.draw_without_rendering()
    (axes,) = figure.axes
    names = [text for text in axes.texts if text.get_text() in bodies]
    assert len(names) == 2
    for name in names:
        box = name.get_window_extent()
        assert axes.bbox.x0 <= box.x0 <= box.x1 <= axes.bbox.x1, name.get_text()


def test_a_pose_that_lacks_a_body_is_refused():
    with pytest.raises(NotDrawable, match="foot"):
        figures.draw_mechanism(SCENE, {body: POSE[body] for body in ("crank", "plate", "block")})


def shaded(motion, name):
    """Spans that each panel of a figure shades, s."""
    figure = drawn(motion, name)
    return [
        [
            tuple(patch.get_extents().transformed(axes.transData.inverted()).intervalx)
            for patch in axes.patches
            if to_hex(patch.get_facecolor()).upper() == colours.UNKNOWN
        ]
        for axes in figure.axes
    ]


@pytest.mark.parametrize("name", ["outputs", "time-history", "contact-force", "certificate"])
def test_what_lies_beyond_the_horizon_is_shaded(motion, name):
    for spans in shaded(motion, name):
        assert spans == [pytest.approx((1.0, 2.0))]
    again = {"horizon": 0.5, "converged": [[0.0, 0.5], [1.5, 2.0]]}
    regained = replace(motion, certified=motion.certified._replace(attributes=again))
    for spans in shaded(regained, name):
        assert spans == [pytest.approx((0.5, 1.5))]


def test_nothing_is_shaded_without_a_certificate(motion):
    assert shaded(replace(motion, certified=None), "outputs") == [[], []]
    with pytest.raises(NotDrawable, match="no certificate"):
        figures.draw(replace(motion, certified=None), "certificate")
