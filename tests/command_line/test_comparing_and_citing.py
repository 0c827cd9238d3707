"""Runs over one another, what to cite, and the description of the interface."""

import json
from importlib.metadata import version
from pathlib import Path

import pytest
import yaml

from jointplay.command_line import certificate, cite

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


def test_jobs_of_a_service_are_compared(jointplay, at, worker, tmp_path):
    ids = [worker.finished(label=label) for label in ("first", "second")]
    chosen = ["--channels", "slider7.x,A.normal_force", "--stop", "0.1"]
    ended = jointplay("compare", *ids, *chosen, "-o", tmp_path / "both.png", *at)
    assert ended.code == 0, ended.err
    lines = [line.split()[:2] for line in ended.out.splitlines()[1:5]]
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
