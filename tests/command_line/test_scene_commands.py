"""``jointplay scene``: look at mechanisms before they are run."""

import json
import os

import pytest

from jointplay.solver.scene import presets
from tests.command_line.four_bar import four_bar
from tests.presets_given import REQUIRED
from tests.solver.cams import follower, pitch_table, valve


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_is_listed_shown_and_passes_its_check(jointplay, name):
    assert name in jointplay("scene", "list").out
    shown = jointplay("scene", "show", name).out
    assert all(parameter in shown for parameter in presets.document(name)["parameters"])
    settings = [f"{key}={value}" for key, value in REQUIRED.get(name, {}).items()]
    checked = jointplay("scene", "check", name, *(f"--set={setting}" for setting in settings))
    assert checked.code == 0
    assert "degrees of freedom" in checked.out
    assert "assembly residual" in checked.out


def test_a_shown_document_can_be_checked_with_parameters_set(jointplay, tmp_path):
    file = tmp_path / "mine.json"
    file.write_text(jointplay("scene", "show", "slider-crank", "--json").out)
    assert json.loads(file.read_text()) == presets.document("slider-crank")
    assert jointplay("scene", "check", file, "--set", "clearance=1e-4").code == 0
    ended = jointplay("scene", "check", file, "--set", "clearence=1e-4")
    assert ended.code == 2
    assert "clearence" in ended.line()


@pytest.mark.parametrize("name", ["slider-crank", "four-bar"])
def test_a_scene_may_come_through_a_pipe(jointplay, name):
    """It was no file: ``There is no file /dev/stdin.``"""
    reader, writer = os.pipe()
    os.write(writer, jointplay("scene", "show", name, "--json").out.encode())
    os.close(writer)
    ended = jointplay("scene", "check", f"/dev/fd/{reader}")
    os.close(reader)
    assert ended.code == 0
    assert ended.out.splitlines()[0].split() == ["scene", name]


def test_assemblies_are_told_apart_by_where_bodies_are(jointplay, tmp_path):
    file = tmp_path / "valve.json"
    file.write_text(json.dumps(valve(follower("roller", pitch_table(24), lash=1e-4))))
    lines = jointplay("scene", "check", file).out.splitlines()
    # it starts as drawn, away from its cam; closed, it is on the side of its guide's point
    # or on the other one
    assert "assemblies             3 found from 25 starts" in lines
    another, beyond = (line for line in lines if line.startswith("another "))
    begins = 'another                "start": {"angles": {"shaft": 0.0, "tappet": 0.0}, "points": '
    assert another.startswith(begins)
    assert beyond.startswith(begins)
    # what is pasted is taken
    for start, height in ((another, 0.048), (beyond, -0.028)):
        document = json.loads(file.read_text()) | json.loads(f"{{{start[23:]}}}")
        file.write_text(json.dumps(document))
        again = jointplay("scene", "check", file).out.splitlines()
        (at,) = (line for line in again if line.startswith("starts at              tappet "))
        assert float(at.split()[4]) == pytest.approx(height, abs=1e-6)  # the table's
        assert sum(line.endswith(", kept") for line in again) == 3


def test_a_smooth_table_that_passes_its_values_is_told_with_how_far_and_where(jointplay, tmp_path):
    scene = valve(follower("flat", {"type": "constant", "value": 0.03}))
    knots = [-0.098, -0.096, -0.092, -0.09]
    table = {"type": "table", "knots": knots, "values": [0.0, 1.0, 1.0, 0.0], "outside": "held"}
    ends = {"first": "ground.S", "second": "tappet.F", "magnitude": 2e4, "direction": [0.0, 1.0]}
    scene["forces"]["punch"] = {"type": "force", "course": table, "over": {"quantity": "y"}} | ends
    file = tmp_path / "valve.json"
    file.write_text(json.dumps(scene))
    assert "overshoot" not in jointplay("scene", "check", file).out
    table["between"] = "smooth"
    file.write_text(json.dumps(scene))
    target = {"path": "/joints/cam/profile/value"}
    scene["parameters"] = {"base": {"help": "Base.", "default": 0.02, "targets": [target]}}
    file.write_text(json.dumps(scene))
    lines = jointplay("scene", "check", file).out.splitlines()
    told = "parameter              base puts 0.02 in place of 0.03 at /joints/cam/profile/value"
    assert told in lines
    (told,) = (line for line in lines if line.startswith("overshoot "))
    assert told.startswith("overshoot              /forces/punch/course: ")
    assert "60 % of their range, most at -0.094; 'monotone' stays within them" in told


@pytest.mark.parametrize("form", ["png", "svg"])
def test_a_mechanism_is_drawn(jointplay, tmp_path, form):
    file = tmp_path / f"press.{form}"
    assert jointplay("scene", "draw", "seven-bar-press", "-o", file).code == 0
    start = file.read_bytes()[:1000]
    assert start.startswith(b"\x89PNG") if form == "png" else b"<svg" in start


def too_short(scene):
    scene["bodies"]["coupler"]["points"] = {"a": [-0.001, 0.0], "b": [0.001, 0.0]}
    scene["bodies"]["rocker"]["points"] = {"a": [-0.1, 0.0], "b": [0.1, 0.0]}


def over_constrained(scene):
    scene["drivers"]["second"] = {"joint": "P", "speed": 10.0, "position": 2.5}


REFUSED = {"too short to close": (too_short, 0), "two drivers": (over_constrained, 1)}


@pytest.mark.parametrize(("spoil", "redundant"), REFUSED.values(), ids=REFUSED)
def test_a_mechanism_that_cannot_run_is_measured_and_drawn_all_the_same(
    jointplay, tmp_path, spoil, redundant
):
    scene = four_bar()
    spoil(scene)
    file, picture = tmp_path / "mine.json", tmp_path / "mine.png"
    file.write_text(json.dumps(scene))
    checked = jointplay("scene", "check", file)
    assert checked.code == 2
    printed = dict(line.split("  ", 1) for line in checked.out.splitlines())
    assert printed["degrees of freedom"].split() == ["0", "(0", "if", "ideal)"]
    assert printed["redundant constraints"].split()[0] == str(redundant)
    assert float(printed["assembly residual"].split()[0]) > 1e-3
    drawn = jointplay("scene", "draw", file, "-o", picture)
    assert drawn.code == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    reason = checked.line().removeprefix("jointplay: ")
    assert drawn.line() == f"jointplay: drawn, but it cannot be run. {reason}"


@pytest.mark.parametrize("command", ["check", "draw"])
def test_what_is_wrong_is_pointed_at_where_it_stands_in_the_file(jointplay, tmp_path, command):
    scene = four_bar()
    scene["joints"]["A"]["journal"] = "coupler.nowhere"
    job = {"kind": "simulate", "scene": scene, "duration": 1.0}
    for document, pointer in ((scene, "/joints/A/journal: "), (job, "/scene/joints/A/journal: ")):
        file = tmp_path / "mine.json"
        file.write_text(json.dumps(document))
        ended = jointplay("scene", command, file)
        assert ended.code == 2
        assert ended.line().startswith(f"jointplay: {pointer}")
        assert ended.out == ""
