"""``jointplay plot --over``: branches over the map of a chart, both in folders."""

import pytest

from jointplay.command_line.application import run

OSCILLATOR = ["run", "impact-oscillator"]
BRANCH = ["--branch", "speed=33:32:2", "--settle", "5"]
CHART = ["--chart", "speed=32:33:2", "--by", "amplitude=4e-3:6e-3:2", "--settle", "5"]


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    place = tmp_path_factory.mktemp("orbits")
    for name, options in (("BRANCH", BRANCH), ("CHART", CHART)):
        assert run([*OSCILLATOR, *options, "--processes", "1", "-o", str(place / name)]) == 0
    return place / "BRANCH", place / "CHART"


def test_a_branch_is_drawn_over_a_chart(jointplay, folders, tmp_path):
    branch, chart = folders
    files = []
    for folder, over in (("alone", []), ("over", ["--over", chart])):
        place = ["-o", tmp_path / folder, "--format", "svg"]
        ended = jointplay("plot", branch, "branch", *over, *place)
        assert ended.code == 0, ended.err
        files.append((tmp_path / folder / "branch.svg").read_text())
    alone, over = files
    assert "amplitude [mm]" not in alone
    assert "amplitude [mm]" in over


def test_what_lies_beneath_must_be_a_map(jointplay, folders, tmp_path):
    branch, chart = folders
    said = jointplay("plot", branch, "branch", "--over", branch, "-o", tmp_path)
    assert "--over: Curves are drawn over a job of kind chart or basins, branches" in said.line()
    said = jointplay("plot", chart, "chart", "--over", chart, "-o", tmp_path)
    assert "--over: The figure 'chart' does not depend on over" in said.line()
    assert "--over chooses what a figure shows" in jointplay("plot", branch, "--over", chart).line()
