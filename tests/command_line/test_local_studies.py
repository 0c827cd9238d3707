"""``jointplay run`` of studies with the real solver, and what can be done with what it leaves."""

import csv
import json
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import zarr
from zarr.storage import ZipStore

from jointplay.command_line.application import run
from jointplay.storage.studies.reader import StudyReader
from jointplay.worker.local.folder import STORE
from jointplay.worker.local.growing import growing_results

CRANK = ["run", "slider-crank"]
DIAGRAM = ["--bifurcation", "clearance=1e-4:5e-4:17", "--settle", "2", "--record", "4"]


@pytest.fixture(scope="module")
def diagram(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Seventeen clearances of the slider-crank, computed by two processes."""
    output = tmp_path_factory.mktemp("diagram") / "OUT"
    assert run([*CRANK, *DIAGRAM, "--processes", "2", "-o", str(output)]) == 0
    return output


def test_a_study_leaves_the_filled_in_job_the_store_and_the_points(diagram):
    job = json.loads((diagram / "job.json").read_text())
    assert (job["kind"], job["settle"], job["continuation"]) == ("bifurcation", 2, "none")
    reader = StudyReader(diagram / "results.zarr.zip")
    reader.verify()
    assert reader.complete
    assert reader.attributes["job"] == job
    assert np.isfinite(reader.sections("P.eccentricity_x")).all()
    period = 2.0 * np.pi / job["scene"]["parameters"]["speed"]
    np.testing.assert_allclose(
        reader.section_times(),
        np.broadcast_to(np.arange(3, 7) * abs(period), (17, 4)),
        rtol=1e-12,
    )
    with (diagram / "points.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["done"] * 17
    assert [float(row["clearance [m]"]) for row in rows] == reader.values[:, 0].tolist()


def test_the_number_of_processes_changes_no_byte(jointplay, diagram, tmp_path):
    again = tmp_path / "AGAIN"
    ended = jointplay("run", diagram / "job.json", "--processes", "1", "-o", again)
    assert ended.code == 0, ended.err
    assert "17 done" in ended.out
    assert (again / STORE).read_bytes() == (diagram / STORE).read_bytes()


def test_sections_are_exported_bit_for_bit_and_drawn(jointplay, diagram, tmp_path):
    file = tmp_path / "sections.csv"
    ended = jointplay("export", diagram, "--channels", "P.eccentricity_y", "-o", file)
    assert ended.code == 0
    with file.open() as lines:
        header, *rows = csv.reader(lines)
    table = np.array(rows, dtype=float)
    reader = StudyReader(diagram / "results.zarr.zip")
    column = table[:, header.index("P.eccentricity_y [m]")]
    np.testing.assert_array_equal(column, reader.sections("P.eccentricity_y").ravel())
    ended = jointplay("plot", diagram, "section", "--start", "16", "--stop", "17", "-o", tmp_path)
    assert ended.code == 0
    assert (tmp_path / "section.png").read_bytes().startswith(b"\x89PNG")
    ended = jointplay("plot", diagram, "section", "-o", tmp_path)
    assert ended.code == 2
    assert "Choose one point" in ended.line()


KINDS = {
    "sweep": (["--sweep", "clearance=1e-4,3e-4", "--sweep", "restitution=0.5,0.9"], 4),
    "poincare": (["--poincare", "--settle", "1", "--record", "5"], 1),
    "ensemble": (["--ensemble", "3", "--settle", "1", "--record", "5"], 3),
}


@pytest.mark.parametrize(("options", "points"), KINDS.values(), ids=KINDS)
def test_every_kind_of_study_runs_locally(jointplay, tmp_path, options, points):
    periods = ["--periods", "2"] if "--sweep" in options else []
    output = tmp_path / "OUT"
    ended = jointplay(*CRANK, *options, *periods, "-o", output)
    assert ended.code == 0, ended.err
    assert f"points    {points} done" in ended.out
    reader = StudyReader(output / "results.zarr.zip")
    assert reader.complete
    assert reader.points == points


def test_a_sensitivity_tells_of_every_output(jointplay, tmp_path):
    drawn = ["--sensitivity", "clearance=uniform:1e-4:3e-4", "--samples", "4", "--periods", "1"]
    ended = jointplay(*CRANK, *drawn, "--statistics", "impacts", "-o", tmp_path / "OUT")
    assert ended.code == 0, ended.err
    assert "4 rows of the design saltelli, 0 left out" in ended.out
    assert "parameter  first order (95%)" in ended.out
    asked = ["sensitivity", tmp_path / "OUT", "--output", "P.impacts", "--limit", "1e6"]
    ended = jointplay(*asked)
    assert ended.out.startswith("P.impacts: ")
    assert "above 1e+06: probability 0 (0 to" in ended.out
    found = json.loads(jointplay(*asked, "--json").out)
    assert (found["output"], found["failure"]["probability"]) == ("P.impacts", 0.0)
    ended = jointplay("sensitivity", tmp_path / "OUT", "--output", "P.impact")
    assert ended.code == 2
    assert ended.line().startswith("jointplay: --output: There is no output 'P.impact'")
    ended = jointplay(*asked, "--failing", "beyond")
    assert ended.line().startswith("jointplay: --failing: ")


def test_statistics_of_a_sweep_are_in_the_store_and_in_the_table(jointplay, tmp_path):
    chosen = ["--statistics", "mean,root_mean_square,contact_share", "--channels", "P.*_force"]
    output = tmp_path / "OUT"
    sweep = [*CRANK, "--sweep", "clearance=1e-4,3e-4", "--periods", "2", "--settle", "1"]
    ended = jointplay(*sweep, *chosen, "-o", output)
    assert ended.code == 0, ended.err
    reader = StudyReader(output / "results.zarr.zip")
    reader.verify()
    mean = zarr.open_group(ZipStore(output / "results.zarr.zip"), mode="r")[
        "statistics/P.normal_force.mean"
    ]
    assert mean.attrs["units"] == "N"
    assert mean.attrs["long_name"] == "mean of normal contact force (joint P)"
    square = reader.statistics["P.normal_force.root_mean_square"]
    assert (square > mean[:]).all()
    assert (reader.peaks("P.normal_force").maximum > square).all()
    with (output / "points.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["P.normal_force.mean [N]"]) for row in rows] == mean[:].tolist()
    share = reader.statistics["P.contact_share"]
    assert [float(row["P.contact_share [1]"]) for row in rows] == share.tolist()
    assert ((share > 0.0) & (share <= 1.0)).all()


def test_points_that_fail_are_named_and_the_others_stand(jointplay, tmp_path):
    """A friction law that is all but a step cannot be followed at the tightest tolerance."""
    stiff = ["--set", "friction=1", "--tolerance", "1e-13", "--set", "static_velocity=1e-12"]
    over = ["--sweep", "dynamic_velocity=1e-12,1e-2", "--duration", "0.05"]
    output = tmp_path / "OUT"
    ended = jointplay("run", "seven-bar-press", *stiff, *over, "-o", output)
    assert ended.code == 0, ended.err
    assert "points    1 done, 1 failed" in ended.out
    assert "point 0 (dynamic_velocity = 1e-12)" in ended.out
    reader = StudyReader(output / "results.zarr.zip")
    assert reader.failures.keys() == {0}
    assert np.isfinite(reader.peaks("displacement").maximum[1])
    alone = jointplay("run", "seven-bar-press", *stiff, "--sweep", "dynamic_velocity=1e-12",
                      "--duration", "0.05", "-o", tmp_path / "ALONE")  # fmt: skip
    assert alone.code == 3
    assert "every point failed" in alone.err.splitlines()[-1]


@pytest.mark.parametrize("processes", [pytest.param("1", marks=pytest.mark.long), "2"])
def test_a_study_that_is_interrupted_ends_with_four_and_keeps_what_was_computed(
    tmp_path, processes
):
    output = tmp_path / "OUT"
    long = ["--bifurcation", "clearance=1e-4:5e-4:400", "--settle", "0", "--record", "500"]
    with subprocess.Popen(
        [sys.executable, "-m", "jointplay", *CRANK, *long, "--processes", processes, "-o", output],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if " points" in line and " 0 of 400" not in line:
                break
        process.send_signal(signal.SIGINT)
        out, rest = process.communicate()
    assert process.returncode == 4, rest
    assert f"To go on: jointplay run --resume {output}" in rest.splitlines()[-1]
    assert "waiting" in out
    assert not (output / STORE).exists()
    reader = growing_results(output)
    assert not reader.complete
    done = int((reader.status == 2).sum())
    assert 0 < done < 400
    assert np.isfinite(reader.sections("P.eccentricity_x")[reader.status == 2]).all()


def test_shares_of_drawn_starts_are_told_over_a_parameter(jointplay, tmp_path):
    ended = jointplay(
        *("run", "impact-oscillator", "-o", str(tmp_path / "OUT"), "--samples", "6"),
        *("--basin-stability", "/start/joints/stop/eccentricity/0=uniform:0.17:0.2"),
        *("--basin-stability", "/drivers/motor/position=uniform:0:6", "--along", "speed=5,28"),
        *("--settle", "60", "--record", "4", "--indicators", "recurrence", "--accuracy", "draft"),
    )
    assert ended.code == 0, ended.err
    assert [line.split("  ")[0] for line in ended.out.splitlines() if "speed = " in line] == [
        "speed = 5 rad/s",
        "speed = 28 rad/s",
    ]
    (table,) = (tmp_path / "OUT").glob("*.csv")
    named = [row["attractor"] for row in csv.DictReader(table.read_text().splitlines())]
    shown = json.loads(jointplay("show", str(tmp_path / "OUT"), "--json").out)["attractors"]
    counts = {one["name"]: one["points"] for one in shown["attractors"]}
    assert counts == Counter(named)
    assert (
        jointplay("plot", str(tmp_path / "OUT"), "basin-stability", "-o", str(tmp_path)).code == 0
    )


def test_a_parameter_over_which_starts_are_drawn_is_not_set(jointplay, tmp_path):
    ended = jointplay(
        *("run", "impact-oscillator", "--set", "speed=28", "-o", str(tmp_path / "OUT")),
        *("--basin-stability", "/drivers/motor/position=uniform:0:6", "--along", "speed=5,28"),
    )
    assert "the study varies speed" in ended.line()


def test_basins_tell_their_attractors(jointplay, tmp_path):
    ended = jointplay(
        *("run", "impact-oscillator", "--set", "speed=28", "-o", str(tmp_path / "OUT")),
        *("--basins", "/start/joints/stop/eccentricity/0=0.18,0.199"),
        *("--by", "/start/joints/stop/rate/0=-0.1,0.5"),
        *("--settle", "100", "--record", "4", "--indicators", "recurrence", "--accuracy", "draft"),
    )
    assert ended.code == 0
    lines = [line for line in ended.out.splitlines() if line.startswith("attractor period-1 ")]
    assert len(lines) == 2
    shown = json.loads(jointplay("show", str(tmp_path / "OUT"), "--json").out)
    assert sum(one["share"] for one in shown["attractors"]["attractors"]) == 1.0
    assert jointplay("plot", str(tmp_path / "OUT"), "chart", "-o", str(tmp_path)).code == 0


def test_a_refined_chart_marks_what_it_inherits(jointplay, tmp_path):
    output = tmp_path / "OUT"
    ended = jointplay(
        *("run", "impact-oscillator", "--chart", "speed=24:40:33", "-o", str(output)),
        *("--by", "amplitude=2e-3:9e-3:9", "--refine", "2", "--settle", "10", "--record", "6"),
        *("--indicators", "recurrence", "--statistics", "impacts", "--accuracy", "draft"),
    )
    assert ended.code == 0, ended.err
    with (output / "points.csv").open() as file:
        inherited = [row["inherited [1]"] for row in csv.DictReader(file)]
    assert len(inherited) == 33 * 9
    count = inherited.count("1")
    assert 27 < inherited.count("0") == len(inherited) - count < 250
    plotted = jointplay("plot", str(output), "chart", "-o", str(tmp_path), "--format", "svg")
    assert plotted.code == 0
    (figure,) = tmp_path.glob("*.svg")
    assert f"{count / len(inherited):.1%} of the points were not computed" in figure.read_text()


def test_rows_of_a_chart_follow_their_neighbours(jointplay, tmp_path):
    """Upwards impacts last to the fold, downwards they begin at grazing."""
    struck = {}
    for way in ("forward", "backward"):
        ended = jointplay(
            *("run", "impact-oscillator", "--chart", "speed=24:34:11", "-o", str(tmp_path / way)),
            *("--by", "amplitude=0.0045,0.005", "--continuation", way, "--settle", "30"),
            *("--record", "4", "--indicators", "recurrence", "--accuracy", "draft"),
            *("--statistics", "impacts"),
        )
        assert ended.code == 0, ended.err
        with (tmp_path / way / "points.csv").open() as file:
            rows = [row for row in csv.DictReader(file) if float(row["stop.impacts [1]"]) > 0]
        struck[way] = {(row["amplitude [m]"], row["speed [rad/s]"]) for row in rows}
    assert struck["backward"] < struck["forward"]


def test_sections_of_a_condition_that_is_never_met_are_told(jointplay, tmp_path):
    output = tmp_path / "OUT"
    never = ["--set", "amplitude=1e-4", "--poincare", "--record", "3", "--section", "onset=stop"]
    ended = jointplay("run", "impact-oscillator", *never, "--settle", "1", "-o", output)
    assert ended.code == 0, ended.err
    told = "sections  0 a point of 3: no onset at stop in 20 periods for each of the others"
    assert told in ended.out.splitlines()
    drawn = jointplay("plot", output, "-o", tmp_path / "figures")
    assert "section: The condition of the section was never met there." in drawn.err


def test_a_law_of_the_name_of_its_family_is_shown_below_the_list(jointplay):
    lines = jointplay("laws", "force").out.splitlines()
    assert [line.split()[1] for line in lines[:2]] == ["spring-damper", "torsion-spring"]
    assert "force (force): F = magnitude * course(...)" in "\n".join(lines)
    assert any(line.split()[:2] == ["direction", "required"] for line in lines)
