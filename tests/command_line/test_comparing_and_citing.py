"""Runs over one another, what to cite, and the description of the interface."""

import csv
import json
import re
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

from jointplay.command_line import certificate, cite
from jointplay.command_line.exits import Exit
from jointplay.local import load

ROOT = Path(__file__).parents[2]


@pytest.fixture
def at(service_url):
    return ["--url", service_url]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    from jointplay.command_line.application import run

    folder = tmp_path_factory.mktemp("runs")
    for name, mass in (("a", "1.0"), ("b", "2.0")):
        arguments = ["run", "pendulum", "--set", f"mass={mass}", "--duration", "1"]
        assert run([*arguments, "-o", str(folder / name)]) == 0
    return folder


def test_local_runs_are_drawn_over_one_another_with_a_table_of_peaks(jointplay, runs, tmp_path):
    ended = jointplay("compare", runs / "a", runs / "b", "-o", tmp_path / "both.svg")
    assert ended.code == 0, ended.err
    assert "mass=1" in ended.out
    assert "mass=2" in ended.out
    assert b"<svg" in (tmp_path / "both.svg").read_bytes()
    table = jointplay("compare", runs / "a", runs / "b", "-o", tmp_path / "c.png", "--json").out
    rows = json.loads(table)["peaks"]
    assert {row["run"] for row in rows} == {"mass=1", "mass=2"}
    for row in rows:
        assert row["minimum"] <= row["maximum"]


def test_a_comparison_says_which_runs_have_not_come_to_their_end(jointplay, runs, tmp_path):
    """A force is given up to 5 mm: the mass is there after 25 ms."""
    course = {"type": "table", "knots": [-5e-3, 5e-3], "values": [0.0, 0.0], "outside": "refused"}
    force = {"type": "force", "first": "ground.O", "second": "mass.c", "direction": [1.0, 0.0]}
    force |= {"magnitude": 1.0, "over": {"quantity": "x"}, "course": course}
    scene = {
        "name": "given-up-to-5-mm",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"mass": {"mass": 1.0, "inertia": 1.0, "points": {"c": [0.0, 0.0]}}},
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "mass.c",
                "axis": [1.0, 0.0],
            }
        },
        "forces": {"given": force},
        "start": {"velocities": {"mass": [0.2, 0.0]}},
    }
    (tmp_path / "short.json").write_text(json.dumps(scene))
    short = tmp_path / "SHORT"
    assert (
        jointplay("run", tmp_path / "short.json", "--duration", "1", "-o", short).code
        == Exit.FAILED
    )
    chosen = ["--channels", "energy.kinetic", "-o", tmp_path / "both.png"]
    ended = jointplay("compare", runs / "a", short, *chosen)
    assert ended.code == 0, ended.err
    (said,) = (line for line in ended.out.splitlines() if " at t = " in line)
    assert re.search(r"failed at t = 0\.025 s of 1 s", said)


@pytest.mark.parametrize(
    "command",
    [
        ("export",),
        ("export", "--table", "peaks"),
        ("export", "--points", "4"),
        ("plot", "energy"),
        ("compare",),
    ],
    ids=" ".join,
)
def test_a_window_after_the_end_of_a_run_is_refused(jointplay, runs, tmp_path, command):
    name, *more = command
    both = [runs / "b"] if name == "compare" else []
    aside = [] if name == "export" else ["-o", tmp_path / "both.png"]
    ended = jointplay(name, runs / "a", *both, *more, "--start", "2", *aside)
    assert ended.code == 2
    assert "--start 2 is after the end of" in ended.line()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("more", [(), ("--step", "0.1"), ("--points", "3")], ids=" ".join)
def test_exported_channels_stand_in_the_order_asked_for(jointplay, runs, more):
    def columns(*channels):
        found = jointplay("export", runs / "a", "--stop", "0.5", *channels, *more)
        rows = csv.reader(line for line in found.out.splitlines() if not line.startswith("#"))
        return {title: values for title, *values in zip(*rows, strict=True)}

    whole = columns()
    part = columns("--channels", "angular_velocity,angle")
    assert [title.split()[0] for title in part] == ["time", "angular_velocity", "angle"]
    for title, values in part.items():
        assert values == whole[title]


def test_runs_of_a_scene_of_ones_own_are_told_apart_by_its_parameters(
    jointplay, runs, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    scene = tmp_path / "mine.json"
    document = json.loads(jointplay("scene", "show", "pendulum", "--json").out)
    scene.write_text(json.dumps(document | {"name": "mine"}))
    for mass in ("3", "4"):
        ended = jointplay("run", scene, "--set", f"mass={mass}", "--duration", "0.1", "-o", mass)
        assert ended.code == 0, ended.err
    own = jointplay("compare", "3", "4", "-o", "own.svg", "--json").out
    assert {row["run"] for row in json.loads(own)["peaks"]} == {"mass=3", "mass=4"}
    other = jointplay("compare", runs / "a", "3", "-o", "other.svg", "--json").out
    labels = {row["run"] for row in json.loads(other)["peaks"]}
    assert labels == {"scene=pendulum mass=1 duration=1", "scene=mine mass=3 duration=0.1"}


def test_channels_are_compared_in_the_order_in_which_they_are_named(jointplay, runs, tmp_path):
    for asked in ("angular_velocity,angle", "angle,angular_velocity"):
        options = ["--channels", asked, "-o", tmp_path / "both.svg"]
        rows = json.loads(jointplay("compare", runs / "a", runs / "b", *options, "--json").out)
        assert ",".join(dict.fromkeys(row["channel"] for row in rows["peaks"])) == asked
        titles = re.findall(r"<!-- (angle|angular_velocity)\b", (tmp_path / "both.svg").read_text())
        assert ",".join(titles) == asked


def test_of_many_figures_the_one_that_cannot_be_drawn_is_named(jointplay, runs, tmp_path):
    names = ("mechanism", "orbit", "nonsense", "energy")
    ended = jointplay("plot", runs / "a", *names, "-o", tmp_path)
    assert ended.code == 2
    said, unknown = ended.err.splitlines()[-2:]  # behind the progress
    assert said.startswith("jointplay: orbit: This figure needs a revolute joint with clearance")
    assert unknown.startswith("jointplay: nonsense: There is no figure 'nonsense'")
    # what comes behind it is drawn nevertheless
    assert {path.name for path in tmp_path.iterdir()} == {"mechanism.png", "energy.png"}
    listed = jointplay("plot", runs / "a", *names, "-o", tmp_path, "--json")
    found = json.loads(listed.out)
    assert [one["name"] for one in found["figures"]] == ["mechanism", "energy"]
    assert [line.partition(":")[0] for line in found["refused"]] == ["orbit", "nonsense"]


def curves_in(svg, across, upright):
    """Curves of the only panel by their labels in the legend, each (2, points), as axes show it."""
    comments = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    by_id = {one.get("id"): one for one in ElementTree.parse(svg, comments).iter()}

    def places(path):
        return np.array(re.findall(r"[ML] (\S+) (\S+)", path.get("d")), float).T

    (left, right), (top, bottom) = (
        (side.min(), side.max()) for side in places(by_id["patch_2"][0])
    )
    legend = ElementTree.tostring(by_id["legend_1"], "unicode")
    labels = dict(re.findall(r"stroke: (#[0-9a-f]+)[^#]*?<!-- (\S+) -->", legend))
    curves = {}
    for path in by_id["axes_1"].findall("{*}g/{*}path[@clip-path]"):
        x, y = places(path)
        colour = re.search("stroke: (#[0-9a-f]+)", path.get("style"))[1]
        shown = np.interp(x, (left, right), across), np.interp(y, (top, bottom), upright[::-1])
        curves[labels[colour]] = shown
    return curves


@pytest.mark.parametrize(("name", "unit"), [("angle", "rad"), ("angular_velocity", "rad/s")])
def test_each_curve_of_a_comparison_is_the_history_of_the_run_that_its_label_names(
    jointplay, runs, tmp_path, name, unit
):
    ends = {"--x-min": 0.2, "--x-max": 0.8, "--y-min": -7.0, "--y-max": 2.0}
    window = ["--channels", name, "--start", 0.2, "--stop", 0.8, "--units", f"{unit},s"]
    options = [str(part) for pair in ends.items() for part in pair]
    drawing = tmp_path / "both.svg"
    ended = jointplay("compare", runs / "a", runs / "b", *window, *options, "-o", drawing)
    assert ended.code == 0, ended.err
    labels = "\n".join(re.findall("<!-- (.*) -->", drawing.read_text()))  # one for each line
    for label in (name, unit), ("time", "s"):
        assert re.search(r"^{}\s\[{}\]$".format(*label), labels, re.MULTILINE)
    curves = curves_in(drawing, (0.2, 0.8), (-7.0, 2.0))
    assert set(curves) == {"mass=1", "mass=2"}
    for folder, label in (("a", "mass=1"), ("b", "mass=2")):
        history = load(runs / folder).history
        inside = history.sel(time=slice(0.2, 0.8))
        drawn = np.interp(inside["time"], *curves[label])
        np.testing.assert_allclose(drawn, inside[name], atol=0.03)  # a third of a line's width


def test_peaks_of_a_comparison_are_those_of_its_window(jointplay, runs, tmp_path):
    window = ["--channels", "angular_velocity", "--start", "0.4", "--stop", "0.6"]
    arguments = ["compare", runs / "a", runs / "b", *window, "-o", tmp_path / "both.png"]
    assert jointplay(*arguments).out.startswith("peaks from t = 0.4 s to t = 0.6 s\n")
    found = json.loads(jointplay(*arguments, "--json").out)
    assert (found["start"], found["stop"]) == (0.4, 0.6)
    for row, folder in zip(found["peaks"], ("a", "b"), strict=True):
        peak = load(runs / folder).results.peaks(0.4, 0.6)["angular_velocity"]
        assert (row["minimum"], row["maximum"]) == (peak.minimum, peak.maximum)
        assert min(row["minimum_time"], row["maximum_time"]) >= 0.4
        assert max(row["minimum_time"], row["maximum_time"]) <= 0.6


def test_a_run_that_leaves_out_settling_says_so_beside_its_peaks(jointplay, runs, tmp_path):
    rest = [*("run", "pendulum", "--set", "mass=1.0"), "--duration", "1", "--settle", "0.5"]
    told = jointplay(*rest, "-o", tmp_path / "OUT")
    assert told.code == 0, told.err
    assert "peaks from t = 0.5 s on" in told.out
    found, expected = (
        load(one).results.peaks(*window)["angular_velocity"]
        for one, window in ((tmp_path / "OUT", ()), (runs / "a", (0.5, 1.0)))
    )
    assert found.maximum == pytest.approx(expected.maximum, abs=1e-6)
    assert found.minimum == pytest.approx(expected.minimum, abs=1e-6)
    compared = jointplay("compare", runs / "a", tmp_path / "OUT", "-o", tmp_path / "x.png").out
    assert compared.count("s on") == 1
    assert jointplay(*rest[:-1], "1.0", "-o", tmp_path / "NO").code == 2


def test_jobs_of_a_service_are_compared(jointplay, at, worker, tmp_path):
    ids = [worker.finished(label=label) for label in ("first", "second")]
    chosen = ["--channels", "slider7.x,A.normal_force", "--stop", "0.1"]
    ended = jointplay("compare", *ids, *chosen, "-o", tmp_path / "both.png", *at)
    assert ended.code == 0, ended.err
    assert ended.out.startswith("peaks to t = 0.1 s\n")
    lines = [line.split()[:2] for line in ended.out.splitlines()[2:6]]
    names = ["slider7.x", "A.normal_force"]
    assert lines == [[name, label] for name in names for label in ("first", "second")]
    assert (tmp_path / "both.png").read_bytes().startswith(b"\x89PNG")


def test_what_cannot_be_compared_is_refused(jointplay, at, runs, finished_sweep, tmp_path):
    figure = ["-o", tmp_path / "x.png"]
    for arguments, words in (
        ([runs / "a", *figure], "2 to"),
        ([runs / "a", runs / "b", "-o", tmp_path / "x.jpg"], ".pdf or .eps"),
        ([runs / "a", finished_sweep, *figure, *at], "sweep"),
        ([runs / "a", tmp_path, *figure], "no results"),
        ([runs / "a", runs / "b", "--width", "900", *figure], "--width"),
        ([runs / "a", runs / "b", "--channels", "none.x", *figure], "none.x"),
    ):
        ended = jointplay("compare", *arguments)
        assert ended.code == 2
        assert words in ended.line()


def test_a_result_is_cited_with_its_source_and_identity(jointplay, at, runs, worker):
    program = jointplay("cite").out
    assert program.startswith("@software{jointplay,")
    local = json.loads(jointplay("cite", runs / "a", "--json").out)
    assert "benchmark A01" in local["source of the scene"]
    assert local["version"] in local["bibtex"]
    first, second = (
        json.loads(jointplay("cite", worker.finished(label=label), "--json", *at).out)
        for label in ("one", "two")
    )
    assert "10.1007/s11012-022-01588-4" in first["source of the scene"]
    assert first["SHA-256 of the job"] == second["SHA-256 of the job"]
    assert first["SHA-256 of the job"] != local["SHA-256 of the job"]


def test_a_certificate_says_until_when_each_channel_is_converged(jointplay, runs):
    ended = jointplay("certificate", runs / "a")
    assert ended.code == 0, ended.err
    assert "energy_residual" in ended.out
    document = json.loads(jointplay("certificate", runs / "a", "--json").out)
    assert "lanes.0                          tolerance 1e-06, perturbed no, " in ended.out
    assert f"converged                        0 to {document['horizon']:.7g}" in ended.out
    for name, channel in document["channels"].items():
        assert f"{name:32} until {channel['until']:.6g} s\n" in ended.out
        assert channel["bar"] in document["bars"]


def test_the_citation_file_says_what_the_command_says():
    document = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert document["title"] == cite.TITLE
    assert [author["name"] for author in document["authors"]] == [cite.AUTHORS]
    assert document["version"] == version("jointplay")
    assert document["cff-version"] == "1.2.0"


def test_the_interface_is_described_without_a_service(jointplay, http, tmp_path):
    document = json.loads(jointplay("openapi").out)
    assert document == http.get("/openapi.json").json()
    assert jointplay("openapi", "-o", tmp_path / "openapi.json").code == 0
    assert json.loads((tmp_path / "openapi.json").read_text()) == document


def test_an_estimate_is_printed_and_nothing_is_queued(jointplay, at, http):
    before = http.get("/v1/jobs").json()["jobs"]
    ended = jointplay("submit", "pendulum", "--duration", "1.9375", "--estimate", *at)
    assert ended.code == 0, ended.err
    assert "of one core" in ended.out
    assert "MB" in ended.out
    assert http.get("/v1/jobs").json()["jobs"] == before


@pytest.mark.parametrize(
    ("job", "exponent", "says"),
    [
        ({}, {"value": 23.0, "error": 1.0}, "--tolerance 1e-07 reaches some 0.1 s further"),
        ({}, {"value": 23.0, "error": 30.0}, "--tolerance 1e-07 reaches further"),
        ({}, None, "how far, that run tells"),
        ({"step": 1e-4}, None, "--step 5e-05, reaches further"),
        ({"duration": 0.5}, None, None),
    ],
)
def test_what_is_known_for_a_part_only_comes_with_advice(job, exponent, says):
    document = {"lanes": [{}], "horizon": 0.5, "exponent": exponent}
    found = certificate._advice({"tolerance": 1e-6, "duration": 2.0} | job, document)
    assert found is None if says is None else says in found
