"""The specification that every figure meets, of runs and of studies."""

import io
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import matplotlib as mpl
import pytest
from closed_form_motion import closed_form_motion
from closed_form_study import (
    accuracy_study,
    bifurcation,
    calibration,
    one_point,
    sensitivity,
    sweep,
)
from drawn import drawn_with, stand_apart, visible_texts
from PIL import Image

from jointplay import figures
from jointplay.figures import FORMS, Selection, saving
from tests.sampled import sampled

MILLIMETRES_AN_INCH = 25.4
UNITS = {"", "s", "Hz", "m", "mm", "µm", "m/s", "mm/s", "N", "kN", "J", "1/s", "m²/Hz"}
UNITS |= {"(m/s)²/Hz", "1/m", "1/(m/s)"}
MOTION = closed_form_motion()
CHOICES = {
    name: Selection(channels=("block.x", "left.normal_force")) for name in ("time-history", "xy")
}
OF_RUNS = {name: (MOTION, name, CHOICES.get(name)) for name in figures.RUN_FIGURES}
OF_STUDIES = {
    "bifurcation": (bifurcation(points=60), "bifurcation", None),
    "with verdicts": (
        bifurcation(points=60, judged=True, failed=(7, 30), unfinished=range(40, 50)),
        "bifurcation",
        None,
    ),
    "exponents": (bifurcation(points=60, judged=True), "exponents", None),
    "in both directions": (bifurcation(points=40, judged=True, both=True), "bifurcation", None),
    "over decades": (
        bifurcation(points=60, logarithmic=True, low=1e-6),
        "bifurcation",
        Selection(channels=("block.x",)),
    ),
    "one value": (bifurcation(points=1), "bifurcation", None),
    "section": (one_point(record=100), "section", None),
    "section of a value": (bifurcation(points=30), "section", Selection(start=29, stop=30)),
    "section of an ensemble": (
        one_point("ensemble", 9, record=50),
        "section",
        Selection(channels=("block.x", "block.vx")),
    ),
    "sweep": (sweep(failed=(7,), unfinished=range(20, 28)), "sweep", None),
    "sweep of one point": (sweep((1,)), "sweep", None),
    "statistic": (sweep(failed=(7,)), "left.normal_force.root_mean_square", None),
    "statistics": (
        sweep(),
        "sweep",
        Selection(channels=("left.normal_force.root_mean_square", "left.contact_share")),
    ),
    "sensitivity": (sensitivity(failed=(7,)), "sensitivity", None),
    "sensitivity of many parameters": (sensitivity(parameters=30), "left.contact_share", None),
    "elementary effects": (sensitivity("morris"), "block.x.minimum", None),
    "correlations": (sensitivity("latin-hypercube"), "block.x", None),
    "work and precision": (accuracy_study(), "work-precision", None),
    "work and precision so far": (accuracy_study(13), "work-precision", None),
    "work and precision without losses": (accuracy_study(lossless=True), "work-precision", None),
    "calibration": (calibration(), "calibration", None),
    "calibration with a target that is only shown": (calibration(fitted=0.0), "calibration", None),
    "map of a statistic": (sweep((8, 6), failed=(3,)), "left.contact_share", None),
    "map": (sweep((8, 6), failed=(3,), unfinished=range(20, 30)), "sweep", None),
}
CASES = OF_RUNS | OF_STUDIES
TAKEN = {type(MOTION): ("values", "section_values"), type(sweep()): ("section_values", "extremes")}
"""Where figures find channels, by the type of their source."""


@pytest.fixture(
    scope="module",
    params=[
        *sampled(OF_RUNS.values(), len(OF_RUNS), OF_RUNS),
        *sampled(OF_STUDIES.values(), 8, OF_STUDIES),
    ],
)
def case(request):
    return request.param


@pytest.fixture(scope="module")
def figure(case):
    return drawn_with(*case)


@pytest.fixture(scope="module")
def pictures(case):
    source, name, selection = case
    before = dict(mpl.rcParams)
    found = {"png": figures.render(source, name, "png", selection)}
    assert dict(mpl.rcParams) == before, "the settings of the caller stay as they were"
    return found


def test_it_is_as_wide_as_a_journal_column(pictures):
    picture = Image.open(io.BytesIO(pictures["png"]))
    width = picture.width / saving.DOTS_PER_INCH * MILLIMETRES_AN_INCH
    assert width == pytest.approx(85.0, abs=0.1)  # a whole number of pixels of 0.085 mm
    assert 30.0 < picture.height / saving.DOTS_PER_INCH * MILLIMETRES_AN_INCH < 235.0


def test_its_axes_say_quantity_and_unit(case, figure):
    for axes in figure.axes:
        if not axes.axison:  # drawn by no scale
            continue
        place = axes.get_subplotspec()
        if axes.name == "polar":
            assert axes.get_title("left").endswith("force [N]")
            continue
        if case[0] is MOTION:
            assert axes.get_xlabel() or not place.is_last_row()
            assert axes.get_ylabel() or not place.is_first_col()
        for label in filter(None, (axes.get_xlabel(), axes.get_ylabel())):
            quantity, _, unit = label.replace("\n", " ").partition(" [")
            assert quantity
            assert unit.removesuffix("]") in UNITS


def test_its_text_is_readable_and_inside_the_page(figure):
    width, height = figure.bbox.size
    for text in visible_texts(figure):
        assert text.get_fontsize() >= 6.0  # points; journals ask for 6 to 8
        box = text.get_window_extent()
        assert -0.5 <= box.x0 <= box.x1 <= width + 0.5, text.get_text()
        assert -0.5 <= box.y0 <= box.y1 <= height + 0.5, text.get_text()
        assert "$" not in text.get_text()  # mathematics that nobody typesets


def test_the_numbers_along_its_axes_stand_apart(figure):
    stand_apart(figure)


def rendered_twice(case, form):
    """Bytes of a figure that two threads draw at the same time."""
    with ThreadPoolExecutor(2) as pool:
        return set(pool.map(lambda _: figures.render(*case[:2], form, case[2]), range(2)))


@pytest.mark.parametrize("form", ["png", "svg"])
def test_the_same_results_give_the_same_bytes_in_any_thread(form):
    (content,) = rendered_twice(CASES["orbit"], form)
    assert content.startswith(b"\x89PNG" if form == "png" else b"<?xml")


@pytest.mark.long
@pytest.mark.parametrize("form", FORMS)
def test_every_figure_has_the_same_bytes_in_any_thread(case, form):
    (content,) = rendered_twice(case, form)
    assert b"<dc:date>" not in content
    assert b"CreationDate" not in content
    assert form in ("png", "eps") or mpl.__version__.encode() not in content


def test_the_required_channels_are_all_it_reads(case, pictures):
    source, name, selection = case
    needed = figures.required(source, name, selection)
    kept = {
        field: {one: found for one, found in getattr(source, field).items() if one in needed}
        for field in TAKEN[type(source)]
    }
    assert figures.render(replace(source, **kept), name, "png", selection) == pictures["png"]
