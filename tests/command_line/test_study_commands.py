"""Studies and batches at a service, from the command line."""

import csv
import io
import json

import pytest

from jointplay.records.job import JobError
from jointplay.storage.catalogue.records import BlockState

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
PRESS = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
SUBMIT = ["submit", "seven-bar-press"]


@pytest.fixture
def at(service_url):
    return ["--url", service_url]


ASKED = {
    "a diagram": (
        ["--bifurcation", "clearance=1e-4:1e-3:200", "--settle", "40", "--record", "30"],
        {
            "kind": "bifurcation",
            "parameter": "clearance",
            "values": {"from": 1e-4, "to": 1e-3, "count": 200, "spacing": "linear"},
            "settle": 40,
            "record": 30,
        },
    ),
    "a diagram in both directions": (
        [
            *["--bifurcation", "speed=3:9:16:log", "--continuation", "both", "--chains", "2"],
            *["--settle", "auto", "--indicators", "all", "--observables", "A.*"],
        ],
        {
            "values": {"from": 3.0, "to": 9.0, "count": 16, "spacing": "log"},
            "continuation": "both",
            "chains": 2,
            "settle": "auto",
        },
    ),
    "whole numbers with an exponent": (
        ["--bifurcation", "speed=3:9:1e1", "--settle", "1e2", "--record", "2e1"],
        {"settle": 100, "record": 20},
    ),
    "a sweep": (
        [
            *["--sweep", "clearance=1e-4:5e-4:3", "--sweep", "friction=0,0.1"],
            *["--periods", "2", "--statistics", "mean,contact_share"],
        ],
        {
            "kind": "sweep",
            "grid": {
                "clearance": {"from": 1e-4, "to": 5e-4, "count": 3, "spacing": "linear"},
                "friction": [0.0, 0.1],
            },
            "periods": 2.0,
            "statistics": ["mean", "contact_share"],
        },
    ),
    "a sensitivity": (
        [
            *["--sensitivity", "clearance_A=uniform:1e-4:5e-4", "--design", "morris"],
            *["--sensitivity", "friction=truncated-normal:0.01:0.002:0:1"],
            *["--periods", "2", "--samples", "8", "--seed", "3"],
        ],
        {
            "kind": "sensitivity",
            "parameters": {
                "clearance_A": {"distribution": "uniform", "low": 1e-4, "high": 5e-4},
                "friction": {
                    "distribution": "truncated-normal",
                    "mean": 0.01,
                    "standard_deviation": 0.002,
                    "low": 0,
                    "high": 1,
                },
            },
            "design": "morris",
            "samples": 8,
            "seed": 3,
            "periods": 2.0,
        },
    ),
    "sections": (
        ["--poincare", "--section", "onset=A", "--set", "friction=0.1"],
        {"kind": "poincare", "section": {"onset": "A"}},
    ),
    "an ensemble": (
        ["--ensemble", "16", "--section", "A.eccentricity_x=1e-4:down"],
        {
            "kind": "ensemble",
            "members": 16,
            "section": {"channel": "A.eccentricity_x", "value": 1e-4, "direction": "down"},
        },
    ),
    "what accuracy costs": (
        ["--accuracy-study", "--duration", "0.5"],
        {"kind": "accuracy-study", "duration": 0.5},
    ),
    "sections at an angle": (
        ["--poincare", "--section", "crank_angle=1.5"],
        {"section": {"crank_angle": 1.5}},
    ),
}


@pytest.mark.parametrize(("options", "fields"), ASKED.values(), ids=ASKED)
def test_a_study_is_asked_for_without_a_document(jointplay, at, options, fields):
    submitted = jointplay(*SUBMIT, *options, *at)
    assert submitted.code == 0, submitted.err
    job = json.loads(jointplay("show", submitted.out.strip(), "--job", *at).out)
    assert {name: job[name] for name in fields} == fields


WRONG = {
    "two kinds": (["--bifurcation", "clearance=1e-4:1e-3:9", "--poincare"], "two jobs"),
    "no range": (["--bifurcation", "clearance"], "NAME=FROM:TO:COUNT"),
    "half a range": (["--bifurcation", "clearance=1e-4:1e-3"], "NAME=FROM:TO:COUNT"),
    "a word in a range": (["--bifurcation", "clearance=1e-4:much:9"], "'much' is not a number"),
    "half a value": (["--bifurcation", "clearance=1e-4:1e-3:9.5"], "/values/count"),
    "an unknown spacing": (["--bifurcation", "clearance=1e-4:1e-3:9:odd"], "NAME=FROM:TO:COUNT"),
    "an unknown parameter": (["--bifurcation", "clearence=1e-4:1e-3:9"], "/parameter"),
    "one method of all": (["--accuracy-study", "--method", "rodas"], "did you mean 'methods'"),
    "no section": (["--poincare", "--section", "A"], "onset=A"),
    "a settling word": (["--poincare", "--settle", "long"], "--settle"),
    "a duration of a diagram": (["--poincare", "--duration", "2"], "/duration"),
    "a record of a simulation": (["--duration", "2", "--record", "9"], "/record"),
    "an unknown distribution": (["--sensitivity", "friction=flat:0:1"], "friction=flat:0:1: write"),
    "half a distribution": (["--sensitivity", "friction=uniform:0"], "uniform:LOW:HIGH"),
    "a distribution twice": (2 * ["--sensitivity", "friction=uniform:0:1"], "given twice"),
    "no periods of a sweep": (["--sweep", "clearance=1e-4,2e-4"], "periods"),
}


@pytest.mark.parametrize(("options", "says"), WRONG.values(), ids=WRONG)
def test_what_is_asked_for_wrongly_ends_with_two_and_one_line(
    jointplay, at, tmp_path, options, says
):
    for command in ([*SUBMIT, *at], ["run", "seven-bar-press", "-o", tmp_path / "OUT"]):
        ended = jointplay(*command, *options)
        assert ended.code == 2
        assert says in ended.line()
        assert not (tmp_path / "OUT").exists()


def test_a_job_of_a_file_is_not_made_another(jointplay, at, tmp_path):
    (tmp_path / "job.json").write_text(json.dumps(PENDULUM))
    ended = jointplay("submit", tmp_path / "job.json", "--poincare", *at)
    assert ended.code == 2
    assert "is a job already" in ended.line()


def test_a_study_is_shown_with_what_became_of_its_points(
    jointplay, at, finished_study, finished_sweep
):
    shown = jointplay("show", finished_study, *at)
    assert shown.code == 0
    assert "bifurcation" in shown.out
    assert "18 done, 2 failed" in shown.out
    assert "sections  6 a point" in shown.out
    assert "verdicts  5 undecided, 5 quasi-periodic, 4 periodic, 4 chaotic" in shown.out
    assert "point 3 (clearance = 0.000242105): The step fell below 1e-15 s." in shown.out
    shown = jointplay("show", finished_sweep, *at)
    assert "A.normal_force" in shown.out
    assert "maximum 1 to 6 N" in shown.out


def test_a_study_that_waits_is_shown(jointplay, at):
    job = jointplay(*SUBMIT, "--poincare", *at).out.strip()
    shown = jointplay("show", job, *at)
    assert shown.code == 0
    assert "queued, 0%" in shown.out


def test_sections_and_points_are_exported(jointplay, at, finished_study, tmp_path):
    window = ["--channels", "A.eccentricity_x", "--start", "3", "--stop", "5"]
    header, *rows = csv.reader(io.StringIO(jointplay("export", finished_study, *window, *at).out))
    assert header == ["point", "clearance [m]", "section", "time [s]", "A.eccentricity_x [m]"]
    assert [row[0] for row in rows] == ["3"] * 3 + ["4"] * 6
    file = tmp_path / "points.json"
    points = ["--table", "points", "--json", "-o", file]
    assert jointplay("export", finished_study, *points, *at).code == 0
    document = json.loads(file.read_text())
    assert document["verdict"][:3] == ["undecided", "periodic", "quasi-periodic"]
    assert document["columns"]["steps [1]"][19] == 1019.0


def test_extremes_of_a_sweep_are_exported(jointplay, at, finished_sweep):
    text = jointplay("export", finished_sweep, "--channels", "A.normal_force", *at).out
    header, *rows = csv.reader(io.StringIO(text))
    maximum = header.index("A.normal_force maximum [N]")
    assert [row[maximum] for row in rows] == ["1", "2", "3", "4", "nan", "6"]
    assert rows[1][header.index("A.normal_force range [N]")] == "4"
    assert rows[1][header.index("A.normal_force.mean [N]")] == "0.5"
    assert rows[1][header.index("A.contact_share [1]")] == "0.5"
    assert "displacement.mean [m]" not in header


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--start", "20"], "points 0 to 19"),
        (["--start", "0.5"], "--start 0.5"),
        (["--start", "2.7"], "--start 2.7"),
        (["--start", "4", "--stop", "4"], "points 0 to 19"),
        (["--points", "9"], "--points is of a history"),
        (["--channels", "A.excentricity_x"], "A.eccentricity_x"),
        (["--channels", "A.excentricity_x", "--table", "points"], "A.excentricity_x"),
    ],
)
@pytest.mark.parametrize("form", ["csv", "npz"])
def test_points_and_observables_that_there_are_not(
    jointplay, at, finished_study, tmp_path, options, says, form
):
    ended = jointplay("export", finished_study, *options, "-o", tmp_path / f"a.{form}", *at)
    assert ended.code == 2
    assert says in ended.line()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", ["csv", "npz"])
def test_channels_of_impacts_are_refused_in_every_form(jointplay, at, finished_job, tmp_path, form):
    asked = ["--table", "impacts", "--channels", "slider7.x", "-o", tmp_path / f"a.{form}"]
    ended = jointplay("export", finished_job, *asked, *at)
    assert ended.code == 2
    assert "--channels are not in the table impacts" in ended.line()


def test_of_a_simulation_there_are_no_points_and_no_samples_beyond_its_end(
    jointplay, at, finished_job
):
    ended = jointplay("export", finished_job, "--table", "points", *at)
    assert ended.code == 2
    assert "--table: a simulation has no table 'points'" in ended.line()
    beyond = jointplay("export", finished_job, "--start", "5", *at)
    assert beyond.code == 2
    assert "--start 5 is after the end of" in beyond.line()


def test_figures_of_a_study_are_fetched(jointplay, at, finished_study, tmp_path):
    assert jointplay("plot", finished_study, "-o", tmp_path, *at).code == 0
    assert (tmp_path / "bifurcation.png").read_bytes().startswith(b"\x89PNG")
    one = ["section", "--start", "4", "--stop", "5", "--joints", "A", "--format", "svg"]
    assert jointplay("plot", finished_study, *one, "-o", tmp_path, *at).code == 0
    assert (tmp_path / "section.svg").exists()
    chosen = jointplay("plot", finished_study, "--start", "4", *at)
    assert chosen.code == 2
    assert "--start" in chosen.line()


def test_a_batch_is_submitted_waited_for_and_looked_at(jointplay, at, worker, tmp_path):
    file = tmp_path / "jobs.json"
    file.write_text(json.dumps({"jobs": [PRESS, PRESS], "label": "pair"}))
    submitted = jointplay("batch", file, *at)
    assert submitted.code == 0
    batch = submitted.out.strip()
    assert jointplay("batch", batch, *at).out == "2 jobs: 2 queued\n"
    listed = jointplay("ls", "-n", "2", *at).out.split()
    for job in (listed[0], listed[listed.index("queued", 3) - 1]):
        claim = worker.start(job)
        worker.store(claim)
        worker.finish(claim, BlockState.done)
    ended = jointplay("batch", batch, "--wait", *at)
    assert ended.code == 0, ended.err
    assert ended.out == "2 jobs: 2 succeeded\n"


def test_waiting_for_a_batch_tells_by_the_exit_code_how_it_ended(jointplay, at, worker, tmp_path):
    file = tmp_path / "jobs.json"
    file.write_text(json.dumps([PRESS]))
    batch = jointplay("batch", file, *at).out.strip()
    assert jointplay("batch", batch, "--cancel", *at).out == "1 jobs: 1 cancelled\n"
    assert jointplay("batch", batch, "--wait", *at).code == 4
    batch = jointplay("batch", file, *at).out.strip()
    claim = worker.start(jointplay("ls", "-n", "1", *at).out.split()[0])
    worker.finish(claim, BlockState.failed, JobError("solver", "step-limit", "Too long."))
    ended = jointplay("batch", batch, "--wait", *at)
    assert ended.code == 3
    assert "1 of 1 jobs failed" in ended.err.splitlines()[-1]


BATCHES = {
    "a bad job": (json.dumps([PENDULUM, PENDULUM | {"duration": -1}]), "/jobs/1/duration"),
    "no list": ('{"kind": "simulate"}', "a list of jobs"),
    "no JSON": ("[", "line 1"),
}


@pytest.mark.parametrize(("text", "says"), BATCHES.values(), ids=BATCHES)
def test_a_wrong_batch_ends_with_two_and_one_line(jointplay, at, tmp_path, text, says):
    file = tmp_path / "jobs.json"
    file.write_text(text)
    ended = jointplay("batch", file, *at)
    assert ended.code == 2
    assert says in ended.line()
    missing = jointplay("batch", tmp_path / "missing.json", *at)
    assert missing.code == 2
    assert "missing.json" in missing.line()


def test_an_accuracy_study_is_shown_as_a_table(jointplay, at, finished_accuracy):
    shown = jointplay("show", finished_accuracy, *at)
    assert shown.code == 0
    assert "| tsitouras | 1e-04 (refused) | 1.0e+00 |" in shown.out
    assert shown.out.rstrip().splitlines()[-1].startswith("The default, tsitouras at 1e-06")
    told = json.loads(jointplay("show", finished_accuracy, "--json", *at).out)
    assert told["accuracy"]["complete"]
