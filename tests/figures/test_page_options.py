"""Options of the page: each does what it says, and refuses what it cannot."""

import hashlib
import io
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from closed_form_motion import closed_form_motion
from closed_form_study import bifurcation
from drawn import visible_texts
from PIL import Image

from jointplay import figures
from jointplay.figures import NotDrawable, Options, Selection, page, saving
from jointplay.records.page_option import FAMILIES, OPTIONS

MOTION = closed_form_motion(samples=201)
FORCE = Selection(joints=("left",))


def laid_out(name, options):
    """A figure with all of its texts where they are saved."""
    with page.style(options.font, options.font_size):
        figure = figures.draw(MOTION, name, None, options)
        figure.draw_without_rendering()
    return figure


def panel(name, selection=None, **options):
    """The first panel of a figure."""
    return figures.draw(MOTION, name, selection, Options(**options)).axes[0]


def test_a_page_has_the_size_that_was_asked_for():
    asked = Options(width=170.0, height=60.0)
    picture = Image.open(io.BytesIO(figures.render(MOTION, "stroke", "png", None, asked)))
    millimetres = [pixels / saving.DOTS_PER_INCH * 25.4 for pixels in picture.size]
    assert millimetres == pytest.approx([170.0, 60.0], abs=0.1)


def test_a_figure_to_scale_grows_in_both_directions():
    before = figures.draw(MOTION, "orbit").get_size_inches()
    after = figures.draw(MOTION, "orbit", None, Options(width=170.0)).get_size_inches()
    np.testing.assert_allclose(after, 2.0 * before)


def test_axes_end_where_they_are_told_in_the_unit_that_they_show():
    axes = panel("left.eccentricity_x", x_min=0.5, y_max=800.0, units="um")
    assert axes.get_xlim() == pytest.approx((0.5, axes.get_xlim()[1]))
    assert axes.get_ylim()[1] == 800.0
    assert axes.get_ylabel() == "left.eccentricity_x\n[µm]"


def test_an_end_alone_leaves_no_white_beside_the_values():
    axes = panel("stroke", x_max=0.5)
    assert axes.get_xlim() == pytest.approx((-0.01, 0.5))


@pytest.mark.parametrize("name", ["stroke", "phase-portrait"])
def test_the_furthest_ends_are_drawn(name):
    end = OPTIONS["y_max"].most
    assert figures.render(MOTION, name, "svg", None, Options(y_min=-end, y_max=end))


def test_a_scale_is_changed_and_numbered_without_mathematics():
    axes = panel("contact-force", FORCE, y_scale="log")
    assert axes.get_yscale() == "log"
    texts = [label.get_text() for label in axes.get_yticklabels()]
    assert any(texts)
    assert not any("$" in text for text in texts)
    assert panel("spectrum", x_scale="linear").get_xscale() == "linear"


@pytest.mark.parametrize("name", ["contact-force", "energy", "mechanism"])
@pytest.mark.parametrize("font", FAMILIES)
def test_all_letters_have_the_font_and_its_size_and_stay_on_the_page(name, font):
    small, large = (
        laid_out(name, Options(font=font, font_size=size, title="The motion"))
        for size in (OPTIONS["font_size"].least, OPTIONS["font_size"].most)
    )
    face = {"sans-serif": "DejaVu Sans", "serif": "DejaVu Serif", "monospace": "DejaVu Sans Mono"}
    assert {text.get_fontname() for text in visible_texts(large)} == {face[font]}
    sizes = [{round(text.get_size(), 6) for text in visible_texts(one)} for one in (small, large)]
    assert sorted(sizes[1]) == pytest.approx([2.0 * size for size in sorted(sizes[0])])
    for text in visible_texts(large):
        box = text.get_window_extent()
        assert -1.0 < box.x0 < box.x1 < large.bbox.width + 1.0, text  # dots
        assert -1.0 < box.y0 < box.y1 < large.bbox.height + 1.0, text


def test_a_title_stands_above_everything_on_a_higher_page():
    for name, explained in (("orbit", True), ("phase-portrait", True), ("pace", False)):
        plain = replace(MOTION, certified=None)
        before = figures.draw(plain, name)
        figure = figures.draw(plain, name, None, Options(title="The motion"))
        assert figure.get_size_inches()[1] > before.get_size_inches()[1]
        figure.draw_without_rendering()
        title = figure.legends[0].get_title() if explained else figure._suptitle
        assert title.get_text() == "The motion"
        lowest = title.get_window_extent().y0
        assert all(axes.get_window_extent().y1 < lowest for axes in figure.axes)


def test_values_that_differ_by_rounding_are_drawn_as_a_constant():
    theta = 0.2 + 1e-16 * np.sin(1e3 * MOTION.time)
    noise = 1e-14 * np.sin(1e3 * MOTION.time)
    values = {**MOTION.values, "plate.theta": theta, "crank.theta": noise}
    for name in ("plate.theta", "crank.theta"):
        (axes,) = figures.draw(replace(MOTION, values=values), name).axes
        low, high = axes.get_ylim()
        assert high - low > 0.01
        assert axes.get_ylabel().partition("[")[2] in ("rad]", "mrad]")


def test_a_grid_that_was_asked_for_by_ratio_is_drawn_so_however_short():
    short = bifurcation(points=20, low=2e-4, high=5e-4, logarithmic=True)
    asked = {"parameter": "play", "values": {"from": 2e-4, "to": 5e-4, "spacing": "linear"}}
    (axes,) = figures.draw(short, "block.x").axes
    assert axes.get_xscale() == "log"
    linear = replace(
        short, attributes={**short.attributes, "job": {**short.attributes["job"], **asked}}
    )
    (axes,) = figures.draw(linear, "block.x").axes
    assert axes.get_xscale() == "linear"


@pytest.mark.long
def test_vectors_for_journals_have_the_same_bytes_in_every_process():
    here = {form: figures.render(MOTION, "stroke", form) for form in ("pdf", "eps")}
    code = (
        "import sys, hashlib; sys.path.insert(0, 'tests/figures');"
        "from closed_form_motion import closed_form_motion;"
        "from jointplay import figures;"
        "motion = closed_form_motion(samples=201);"
        "drawn = [figures.render(motion, 'stroke', form) for form in ('pdf', 'eps')];"
        "print(*(hashlib.sha256(one).hexdigest() for one in drawn))"
    )
    there = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert there.stdout.split() == [hashlib.sha256(one).hexdigest() for one in here.values()]
    assert not any(b"Date" in one for one in here.values())


@pytest.mark.parametrize(
    ("name", "options", "cause", "says"),
    [
        ("orbit", {"width": 10.0}, "width", "between 80 and 210 mm"),
        ("orbit", {"x_scale": "log"}, "x_scale", "drawn to scale"),
        ("orbit", {"y_max": 1e30}, "y_max", "1000 times the other"),
        ("stroke", {"x_scale": "cubic"}, "x_scale", "linear or log"),
        ("outputs", {"y_min": 0.0}, "y_min", "different units"),
        ("stroke", {"x_min": 1.0, "x_max": 1.0}, "x_max", "above x_min"),
        ("stroke", {"x_min": 9.0}, "x_min", "beyond the limit"),
        ("stroke", {"title": "two\nlines"}, "title", "one line"),
        ("stroke", {"units": "mm,furlong"}, "units", "furlong"),
        ("stroke", {"font": "Comic"}, "font", "sans-serif, serif or monospace"),
        ("stroke", {"font_size": 72.0}, "font_size", "between 5 and 10 pt"),
        ("stroke", {"y_max": float("nan")}, "y_max", "is a number"),
        ("stroke", {"y_max": 1e308}, "y_max", "and 1e\\+30."),
        ("left.normal_force", {"y_scale": "log", "y_min": 0.0}, "y_min", "above zero"),
    ],
)
def test_what_an_option_cannot_mean_is_refused(name, options, cause, says):
    with pytest.raises(NotDrawable, match=says) as caught:
        figures.draw(MOTION, name, None, Options(**options))
    assert caught.value.cause == cause


def test_every_option_is_a_field_with_a_meaning():
    assert list(Options.__dataclass_fields__) == list(OPTIONS)
    assert all(option.help for option in OPTIONS.values())
