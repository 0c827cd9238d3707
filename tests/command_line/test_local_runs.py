"""``jointplay run`` with the real solver, and what can be done with what it leaves."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from jointplay.command_line.application import run
from jointplay.storage.results.reader import ResultReader

PRESS = ["run", "seven-bar-press", "--duration", "0.05", "--output-step", "1e-3"]


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A twentieth of a second of the press: the first impacts at both joints."""
    output = tmp_path_factory.mktemp("press") / "OUT"
    assert run([*PRESS, "--set", "clearance=3e-4", "-o", str(output)]) == 0
    return output


def test_a_run_leaves_the_filled_in_job_the_store_and_the_peaks(press):
    job = json.loads((press / "job.json").read_text())
    assert job["scene"]["parameters"]["clearance"] == 3e-4
    assert job["scene"]["parameters"]["restitution"] == 0.9
    assert job["tolerance"] == 1e-6
    reader = ResultReader(press / "results.zarr.zip")
    reader.verify()
    assert reader.complete
    assert reader.attributes["job"] == job
    with (press / "peaks.csv").open() as file:
        rows = {row["channel"]: row for row in csv.DictReader(file)}
    assert rows.keys() == reader.peaks().keys()
    assert float(rows["A.normal_force"]["maximum"]) == reader.peaks()["A.normal_force"].maximum
    assert not (press / "figures").exists()  # drawn when they are asked for


def test_the_job_it_leaves_repeats_every_bit(jointplay, press, tmp_path):
    again = tmp_path / "AGAIN"
    ended = jointplay("run", press / "job.json", "-o", again)
    assert ended.code == 0
    assert "displacement" in ended.out
    first, second = (
        ResultReader(press / "results.zarr.zip"),
        ResultReader(again / "results.zarr.zip"),
    )
    for (time, ours), (other_time, theirs) in (
        (first.history(), second.history()),
        (first.sections(), second.sections()),
    ):
        assert time.tobytes() == other_time.tobytes()
        assert {name: column.tobytes() for name, column in ours.items()} == {
            name: column.tobytes() for name, column in theirs.items()
        }
    assert first.impacts().tobytes() == second.impacts().tobytes()
    assert (press / "peaks.csv").read_bytes() == (again / "peaks.csv").read_bytes()


def test_local_results_are_exported_bit_for_bit(jointplay, press, tmp_path):
    file = tmp_path / "press.csv"
    ended = jointplay("export", press, "--channels", "slider7.*,A.normal_force", "-o", file)
    assert ended.code == 0
    with file.open() as lines:
        header, *rows = csv.reader(lines)
    assert header[0] == "time [s]"
    table = np.array(rows, dtype=float)
    time, columns = ResultReader(press / "results.zarr.zip").history(["slider7.vx"])
    assert (table[:, 0] == time).all()
    assert (table[:, header.index("slider7.vx [m/s]")] == columns["slider7.vx"]).all()
    window = ("--start", "0.01", "--stop", "0.011", "--step", "1e-5")
    assert jointplay("export", press, "--channels", "slider7.vx", *window, "-o", file).code == 0
    assert len(file.read_text().splitlines()) == 1 + 101
    near = jointplay("export", press, "--channels", "slider7.vX")
    assert near.code == 2
    assert "slider7.vx" in near.line()


@pytest.mark.parametrize("content", ["", "{", "[]", "7", '{"state": "succeeded"}', "\x00"])
def test_an_outcome_that_is_damaged_is_named(jointplay, press, tmp_path, content):
    folder = shutil.copytree(press, tmp_path / "OUT")
    (folder / "outcome.json").write_text(content)
    shown = jointplay("show", folder)
    assert shown.code == 2
    assert "outcome.json is not what was written; remove it" in shown.line()
    (folder / "outcome.json").unlink()
    assert "succeeded" in jointplay("show", folder).out


@pytest.mark.parametrize("kept", [0, 100, -1])
def test_results_that_are_cut_off_are_named(jointplay, press, tmp_path, kept):
    store = tmp_path / "results.zarr.zip"
    store.write_bytes((press / "results.zarr.zip").read_bytes()[:kept])
    for command in ("show", "export", "plot"):
        assert "results.zarr.zip is cut off" in jointplay(command, tmp_path).line()


def test_local_results_are_drawn(jointplay, press, tmp_path):
    drawn = jointplay("plot", press, "orbit", "A.penetration", "--format", "svg", "-o", tmp_path)
    assert drawn.code == 0
    assert {file.name for file in tmp_path.iterdir()} == {"orbit.svg", "A.penetration.svg"}
    for other in ("job.json", "peaks.csv"):
        said = jointplay("plot", press / other, "orbit", "-o", tmp_path).line()
        assert f"{other} is no store of results: give a run's folder" in said
    unknown = jointplay("plot", press, "obrit", "-o", tmp_path)
    assert unknown.code == 2
    assert "orbit" in unknown.line()
    late = jointplay("plot", press, "orbit", "--start", "99", "-o", tmp_path)
    assert late.line().startswith("jointplay: --start 99 is after the end of")
    one = tmp_path / "new" / "press.svg"
    assert jointplay("plot", press, "orbit", "-o", one).out.split() == [str(one)]
    assert one.read_bytes() == (tmp_path / "orbit.svg").read_bytes()
    several = jointplay("plot", press, "orbit", "energy", "-o", one)
    assert "is one file: name one figure, or a folder" in several.line()
    picture = jointplay("plot", press, "orbit", "-o", tmp_path / "press.jpg")
    assert "are written as png, svg" in picture.line()
    other = jointplay("plot", press, "orbit", "--format", "pdf", "-o", one)
    assert "--format pdf is not that of 'press.svg'" in other.line()
    wrong = jointplay("plot", press, "orbit", "--joints", "Z", "-o", tmp_path)
    assert wrong.line().startswith("jointplay: --joints: ")
    some = jointplay("plot", press, "time-history", "orbit", "-o", tmp_path)
    assert "jointplay: time-history: --channels: Say which channels" in some.err
    assert some.out.split() == [str(tmp_path / "orbit.png")]


def test_a_film_is_drawn_of_a_local_run(jointplay, press, tmp_path):
    pace = ["--stop", "0.01", "--rate", "0.01", "--frames-per-second", "5"]
    drawn = jointplay("plot", press, "animation", *pace, "-o", tmp_path)
    assert drawn.out.split() == [str(tmp_path / "animation.gif")]
    with Image.open(tmp_path / "animation.gif") as film:
        assert film.n_frames == 5
        assert film.info["duration"] == 200  # ms: 10 ms of the press take a second
    for wrong in (
        ["orbit", "--impact-to-impact"],
        ["orbit", *pace],
        ["animation", "--format", "png", "--rate", "0.1"],
    ):
        assert "is of a film alone" in jointplay("plot", press, *wrong).line()
    assert "leave them out" in jointplay("plot", press, "animation", "--channels", "A.x").line()


def test_selected_channels_are_all_that_is_stored(jointplay, tmp_path):
    output = tmp_path / "OUT"
    arguments = [*PRESS, "--channels", "displacement,B.*force", "-o", output]
    assert jointplay(*arguments).code == 0
    stored = [channel.name for channel in ResultReader(output / "results.zarr.zip").channels]
    assert stored == ["B.normal_force", "B.friction_force", "displacement"]


def test_a_run_that_fails_ends_with_three_says_what_to_try_and_keeps_the_rest(jointplay, tmp_path):
    output = tmp_path / "OUT"
    stiffest = ["--set", "friction=1", "--tolerance", "1e-13"]  # a step in the friction law:
    stiffest += ["--set", "static_velocity=1e-12", "--set", "dynamic_velocity=1e-12"]
    ended = jointplay(*PRESS, *stiffest, "-o", output)
    assert ended.code == 3
    line = ended.err.splitlines()[-1]
    assert "step" in line
    assert "larger tolerance" in line
    reader = ResultReader(output / "results.zarr.zip")
    assert not reader.complete
    assert 0 < reader.samples < 51
    assert reader.history(["displacement"])[0][-1] < 0.05


def test_figures_are_drawn_with_the_run_if_asked_for(jointplay, tmp_path):
    swing = ["pendulum", "--duration", "0.1", "--channels", "rod.*"]
    assert jointplay("run", *swing, "--figures", "-o", tmp_path / "OUT").code == 0
    assert jointplay("plot", tmp_path / "OUT", "-o", tmp_path / "later").code == 0
    drawn = {file.name: file.read_bytes() for file in (tmp_path / "OUT" / "figures").iterdir()}
    assert drawn
    assert drawn == {file.name: file.read_bytes() for file in (tmp_path / "later").iterdir()}


def test_a_run_that_is_ended_from_outside_ends_with_four_and_keeps_what_was_computed(tmp_path):
    output = tmp_path / "OUT"
    arguments = ["run", "seven-bar-press", "--duration", "100000", "--output-step", "0.5"]
    with subprocess.Popen(
        [sys.executable, "-m", "jointplay", *arguments, "--channels", "displacement", "-o", output],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    ) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if "t = " in line and "t = 0 s" not in line:
                break
        process.send_signal(signal.SIGTERM)
        rest = process.stderr.read()
    assert process.returncode == 4, rest
    assert f"To go on: jointplay run --resume {output}" in rest.splitlines()[-1]
    assert json.loads((output / "job.json").read_bytes())["duration"] == 100_000.0
    reader = ResultReader(output / "results.zarr.zip")
    assert reader.sealed
    assert not reader.complete
    assert 0 < reader.samples < 200_001
