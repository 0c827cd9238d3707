"""Whatever is typed wrong: exit code 2 and one line that names the field and what is right."""

import builtins
import json

import pytest

import jointplay as package
from jointplay import client, figures
from jointplay.command_line import application
from jointplay.command_line.application import EXITS
from jointplay.command_line.job_document import job_document
from jointplay.exports import table_query
from jointplay.records import failure, strict_json, table_files
from jointplay.service import processes
from jointplay.service.processes.folder_lock import holding
from jointplay.solver.scene import presets
from jointplay.storage import errors
from jointplay.storage.catalogue import errors as of_the_catalogue

PRESS = ["run", "seven-bar-press", "-o", "OUT"]
TIMED = [*PRESS, "--duration", "2"]
DIAGRAM = ["--bifurcation", "clearance=1e-4:5e-4:9", "--settle", "1", "--record", "1"]

WRONG = {
    "unknown command": (["frobnicate"], "frobnicate"),
    "no output": (["run", "seven-bar-press", "--duration", "2"], "--output"),
    "no duration": (PRESS, "/duration"),
    "duration zero": ([*PRESS, "--duration", "0"], "/duration"),
    "duration negative": ([*PRESS, "--duration", "-1"], "/duration"),
    "duration NaN": ([*PRESS, "--duration", "nan"], "/duration"),
    "duration infinite": ([*PRESS, "--duration", "inf"], "/duration"),
    "duration 1e400": ([*PRESS, "--duration", "1e400"], "/duration"),
    "duration a word": ([*PRESS, "--duration", "10ms"], "'--duration': give a number, such as 0.5"),
    "help of the command": ([*PRESS, "--duration", "10ms"], "(see: jointplay run --help)"),
    "a count a word": (["ls", "-n", "ten"], "'--count': give a whole number"),
    "a count below one": (["ls", "-n", "0"], "'--count': give a number greater than or equal to 1"),
    "a time a word": (["ls", "--since", "yesterday"], "'--since': give a time, such as 2026-"),
    "too many periods": ([*PRESS, "--duration", "1e7"], "/duration"),
    "no members": ([*PRESS, "--ensemble", "0", "--record", "1"], "/members"),
    "a share of a section": ([*PRESS, "--poincare", "--record", "1.5"], "'1.5' is not a whole"),
    "a share of a period": ([*PRESS, "--poincare", "--settle", "1.5"], "/settle"),
    "a word for a number": ([*PRESS, "--ensemble", "ten"], "'--ensemble': 'ten' is not a whole"),
    "unknown preset": (["run", "six-bar-press", "-o", "OUT", "--duration", "2"], "/scene/preset"),
    "unknown parameter": ([*TIMED, "--set", "clearence=1e-4"], "clearence"),
    "a value twice": (
        [*TIMED, "--set", "clearance=1e-4", "--set", "clearance=2e-4"],
        "--set clearance is given twice",
    ),
    "an axis twice": (
        [*TIMED, "--sweep", "clearance=1e-4,2e-4", "--sweep", "clearance=3e-4"],
        "--sweep clearance is given twice",
    ),
    "two diagrams": (
        [*PRESS, "--bifurcation", "speed=3:9:4", "--bifurcation", "friction=0.1,0.2"],
        "extremes over all of them: --sweep speed=3:9:4 --sweep friction=0.1,0.2",
    ),
    "a value that the diagram varies": (
        [*PRESS, "--set", "speed=3", "--bifurcation", "speed=3:9:4"],
        "--set speed: the study varies speed",
    ),
    "a value that the sweep varies": (
        [*TIMED, "--set", "friction=0.1", "--sweep", "friction=0.1,0.2"],
        "--set friction: the study varies friction",
    ),
    "a value that an axis of a chart varies": (
        [*PRESS, "--set", "speed=3", "--chart", "speed=3:9:4", "--by", "friction=0.1,0.2"],
        "--set speed: the study varies speed",
    ),
    "a value that a sensitivity draws": (
        [*PRESS, "--set", "friction=0.1", "--sensitivity", "friction=uniform:0:0.1"],
        "--set friction: the study varies friction",
    ),
    "no value": ([*TIMED, "--set", "clearance"], "NAME=VALUE"),
    "negative clearance": ([*TIMED, "--set", "clearance=-1e-4"], "/scene/parameters/clearance"),
    "clearance too large": ([*TIMED, "--set", "clearance=5e-3"], "/scene/parameters/clearance"),
    "clearance NaN": ([*TIMED, "--set", "clearance=NaN"], "/scene/parameters/clearance"),
    "unknown channel": ([*TIMED, "--channels", "slider8.x"], "/channels/0"),
    "unknown formulation": ([*TIMED, "--formulation", "newton"], "/formulation"),
    "too many samples": ([*TIMED, "--output-step", "1e-9"], "/output_step"),
    "processes of one simulation": ([*TIMED, "--processes", "2"], "--processes"),
    "no device": ([*PRESS, *DIAGRAM, "--device", "gpu"], "/device: 'gpu' is no device"),
    "no such device": ([*PRESS, *DIAGRAM, "--device", "cuda:9999"], "cannot be opened"),
    "a device for one simulation": ([*TIMED, "--device", "cuda:0"], "/kind: A device computes no"),
    "no such file": (["run", "missing.json", "-o", "OUT"], "missing.json"),
    "a folder without a job": (["run", ".", "-o", "OUT"], ". is a folder; give a job or a scene"),
    "no address at all": (["ls", "--url", "foo"], "it has no http:// in front"),
    "nothing to resume": (["run", "--resume", "missing"], "missing holds no run"),
    "a seed to resume": (["run", "--resume", "missing", "--seed", "0"], "beside it there can only"),
    "no settling": (["run", "--resume", "missing", "--settle", "0"], "beside it there can only"),
    "more to resume": (["run", "slider-crank", "--resume", "missing"], "beside it there can only"),
    "no such results": (["export", "missing"], "missing"),
    "a folder without results": (["plot", "."], "no results"),
    "unknown format": (["export", "missing", "--format", "xls"], "'--format': 'xls' is not one of"),
    "unknown table": (["export", "missing", "--table", "x"], "'--table': 'x' is not one of"),
    "no such scene": (["scene", "show", "six-bar-press"], "six-bar-press"),
    "a scene that cannot be drawn into that": (
        ["scene", "draw", "pendulum", "-o", "pendulum.doc"],
        ".png",
    ),
    "a window that ends before it begins": (
        ["export", "missing", "--start", "1", "--stop", "0.5"],
        "--stop 0.5 is before --start 1",
    ),
    "a figure that ends before it begins": (
        ["plot", "missing", "orbit", "--start", "1", "--stop", "0.5"],
        "--stop 0.5 is before --start 1",
    ),
    "a comparison that ends before it begins": (
        ["compare", "missing", "missing", "--start", "1", "--stop", "0.5"],
        "--stop 0.5 is before --start 1",
    ),
    "a window from nowhere": (["export", "missing", "--start", "nan"], "--start nan"),
    "not an address": (["ls", "--url", "localhost"], "is not an address"),
    "no reported numbers": (["demo", "pendulum"], "no reported numbers"),
}


@pytest.mark.parametrize(("arguments", "says"), WRONG.values(), ids=WRONG)
def test_wrong_usage_ends_with_two_and_one_line(jointplay, tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    ended = jointplay(*arguments)
    assert ended.code == 2
    assert says in ended.line()
    assert list(tmp_path.iterdir()) == []


FILES = {
    "malformed": (b'{"kind": "simul', "line 1"),
    "not an object": (b"[1, 2]", "JSON object"),
    "NaN": (b'{"kind": "simulate", "duration": NaN}', "/duration"),
    "1e400": (b'{"kind": "simulate", "duration": 1e400}', "/duration"),
    "a key twice": (b'{"kind": "simulate", "kind": "simulate"}', "/kind"),
    "unknown field": (b'{"kind": "simulate", "durations": 1}', "/durations"),
    "unknown kind": (b'{"kind": "simulation"}', "/kind"),
    "100 000 levels": (b"[" * 100_000, "nested"),
    "not UTF-8": (b"\xff\xfe", "UTF-8"),
}


@pytest.mark.parametrize(("content", "says"), FILES.values(), ids=FILES)
def test_a_wrong_file_ends_with_two_and_a_line_for_each_fault(jointplay, tmp_path, content, says):
    (tmp_path / "job.json").write_bytes(content)
    ended = jointplay("run", tmp_path / "job.json", "-o", tmp_path / "OUT")
    assert ended.code == 2
    assert [says in line for line in ended.lines()].count(True) == 1
    assert not (tmp_path / "OUT").exists()


def test_a_scene_in_yaml_is_refused_as_such(jointplay, tmp_path):
    (tmp_path / "mine.yaml").write_text("name: mine\nbodies:\n\tcrank: {mass: 1}\n")
    line = jointplay("scene", "check", tmp_path / "mine.yaml").line()
    assert "mine.yaml: jobs and scenes are read as JSON, not as YAML" in line


def test_a_batch_of_what_is_no_job_ends_with_two_and_one_line(jointplay, tmp_path):
    (tmp_path / "jobs.json").write_text('[{"kind": "simulate"}, 7]')
    ended = jointplay("batch", tmp_path / "jobs.json")
    assert ended.code == 2
    assert "/jobs/1: a job is a JSON object" in ended.line()


@pytest.mark.parametrize("option", [["--wait"], ["--cancel"], ["--label", "mine"]])
def test_what_is_of_one_batch_is_refused_without_it(jointplay, service_url, option):
    ended = jointplay("batch", *option, "--url", service_url)
    assert (ended.code, ended.out) == (2, "")
    assert "give its file or id" in ended.line()


def test_a_variable_that_is_nearly_a_setting_is_told(jointplay, tmp_path, monkeypatch):
    monkeypatch.setenv("JOINTPLAY_LEESE", "10")
    with holding(tmp_path):
        ended = jointplay("serve", "--port", "0", "--data", tmp_path)
    told, _ = ended.lines()
    assert "JOINTPLAY_LEESE is not a setting, and changes nothing" in told
    assert told.endswith("did you mean 'JOINTPLAY_LEASE'?")


def test_several_faults_are_a_line_each(jointplay, tmp_path):
    (tmp_path / "job.json").write_text('{"kind": "simulate", "durations": 1}')
    lines = jointplay("run", tmp_path / "job.json", "-o", tmp_path / "OUT").lines()
    pointers = ["/scene", "/duration", "/durations"]
    assert [line.split(":")[1].strip() for line in lines] == pointers
    refused = client.Refused(
        "Two.", fields=[client.FieldProblem("/a", "One."), client.FieldProblem("", "Other.")]
    )
    assert application._lines_of(refused) == ["/a: One.", "Other."]


SHAPELESS = {
    "a preset with a list of values": {"preset": "pendulum", "parameters": [1]},
    "a scene with a list of parameters": {"bodies": {}, "parameters": [1]},
    "a scene with a number for a parameter": {"bodies": {}, "parameters": {"a": 3}},
}


@pytest.mark.parametrize("scene", SHAPELESS.values(), ids=SHAPELESS)
def test_a_parameter_set_in_a_wrong_file_says_what_is_wrong_with_the_file(
    jointplay, tmp_path, scene
):
    job = {"kind": "simulate", "scene": scene, "duration": 1.0}
    (tmp_path / "job.json").write_text(json.dumps(job))
    ended = jointplay("run", tmp_path / "job.json", "--set", "a=1", "-o", tmp_path / "OUT")
    assert ended.code == 2
    assert "/scene/parameters" in ended.err


@pytest.mark.parametrize(
    "varies",
    [
        {"kind": "sweep", "grid": {"speed": [3.0, 4.0]}, "duration": 0.1},
        {"kind": "sweep", "points": [{"speed": 3.0}, {"speed": 4.0}], "duration": 0.1},
        {"kind": "bifurcation", "parameter": "speed", "values": [3.0, 4.0]},
    ],
    ids=["by a grid", "by a list", "by a diagram"],
)
def test_a_value_that_a_job_in_a_file_varies_is_refused(jointplay, tmp_path, varies):
    scene = presets.document("seven-bar-press")
    (tmp_path / "job.json").write_text(json.dumps(varies | {"scene": scene}))
    ended = jointplay("run", tmp_path / "job.json", "--set", "speed=5", "-o", tmp_path / "OUT")
    assert ended.code == 2
    assert "--set speed: the study varies speed" in ended.line()


@pytest.mark.parametrize("setting", [["--set", "friction=0.1,0.2"], ["--set=friction=0.1,0.2"]])
def test_a_value_that_is_none_is_refused_as_it_was_typed(jointplay, tmp_path, setting):
    (tmp_path / "own.json").write_text(json.dumps(presets.document("slider-crank")))
    timed = ["--duration", "1", "-o", tmp_path / "OUT"]
    ended = jointplay("run", tmp_path / "own.json", *timed, *setting)
    assert ended.line() == "jointplay: --set friction: 'friction' is a number."
    checked = jointplay("scene", "check", tmp_path / "own.json", *setting)
    assert checked.line() == "jointplay: --set friction: 'friction' is a number."


SERVING = {
    "not a number": ({"JOINTPLAY_LEASE": "abc"}, [], "JOINTPLAY_LEASE: "),
    "impossible together": ({"JOINTPLAY_LEASE": "1"}, [], "JOINTPLAY_HEARTBEAT"),
    "not a Redis": ({"JOINTPLAY_REDIS_URL": "foo"}, [], "JOINTPLAY_REDIS_URL: "),
    "not a host": ({}, ["--host", "256.0.0.1"], "256.0.0.1"),
}


@pytest.mark.parametrize(("variables", "arguments", "says"), SERVING.values(), ids=SERVING)
def test_a_service_with_wrong_settings_ends_with_two_and_one_line(
    jointplay, tmp_path, monkeypatch, variables, arguments, says
):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    ended = jointplay("serve", "--port", "0", "--data", tmp_path / "new", *arguments)
    assert ended.code == 2
    assert says in ended.line()
    assert not (tmp_path / "new").exists()


def test_the_data_folder_may_be_named_by_the_environment(jointplay, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("JOINTPLAY_DATA", "named")
    monkeypatch.setenv("JOINTPLAY_REDIS_URL", "redis://127.0.0.1:1/0")  # so that it never serves
    with holding(tmp_path / "named"):
        ended = jointplay("serve", "--port", "0")
    assert ended.code == 2
    assert f"{tmp_path / 'named'} is in use" in ended.line()


def test_an_existing_output_is_never_overwritten(jointplay, tmp_path):
    ended = jointplay("run", "pendulum", "--duration", "1", "-o", tmp_path)
    assert ended.code == 2
    assert "exists already" in ended.line()


def test_a_scene_of_ones_own_is_checked_like_a_preset(jointplay, tmp_path):
    scene = presets.document("seven-bar-press")
    file = tmp_path / "mine.json"
    file.write_text(json.dumps(scene))
    checked = jointplay("scene", "check", file)
    assert checked.code == 0
    assert checked.out == jointplay("scene", "check", "seven-bar-press").out
    scene["joints"]["A"]["journal"] = "link2.nowhere"
    file.write_text(json.dumps(scene))
    ended = jointplay("scene", "check", file)
    assert ended.code == 2
    assert "jointplay: /joints/A" in ended.line()
    assert "nowhere" in ended.line()


def test_exit_codes_are_of_exceptions_that_there_are():
    """They are named and not imported: a name that nothing has would never be met."""
    modules = (
        builtins,
        client,
        failure,
        strict_json,
        processes,
        figures,
        errors,
        of_the_catalogue,
    )
    modules += (table_query, table_files)
    unknown = [name for name in EXITS if not any(hasattr(module, name) for module in modules)]
    assert unknown == []


@pytest.mark.parametrize("arguments", [[], ["scene"]], ids=["alone", "a group alone"])
def test_what_needs_a_command_shows_its_help_and_nothing_else(jointplay, arguments):
    ended = jointplay(*arguments)
    assert (ended.code, ended.err) == (0, "")
    assert "Commands" in ended.out


def test_the_version_is_told(jointplay):
    assert jointplay("--version").out == f"jointplay {package.__version__}\n"


def test_shells_complete_commands(jointplay, monkeypatch, capsys):
    monkeypatch.setenv("_JOINTPLAY_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", "jointplay repr")
    monkeypatch.setenv("COMP_CWORD", "1")
    with pytest.raises(SystemExit):
        jointplay()
    assert capsys.readouterr().out.split() == ["reproduce"]


def test_a_folder_of_a_run_is_told_from_its_job(jointplay, tmp_path):
    (tmp_path / "job.json").write_text("{}")
    assert f"give {tmp_path / 'job.json'}" in jointplay("run", tmp_path, "-o", "OUT").line()


def test_sentences_of_a_service_name_commands():
    error = client.NotFound("There is no job 'x'; GET /v1/jobs lists the jobs.")
    assert application._lines_of(error) == ["There is no job 'x'; `jointplay ls` lists the jobs."]


@pytest.mark.parametrize(("typed", "read"), [(".3", 0.3), ("5.", 5.0), ("-.1e-3", -1e-4)])
def test_numbers_are_typed_as_people_write_them(typed, read):
    job = job_document("pendulum", settings=[f"mass={typed}"], options={})
    assert job["scene"]["parameters"] == {"mass": read}
