"""The specification that every command meets."""

import inspect
import json

import pytest
import typer

from jointplay.client import Batch, Client, Job
from jointplay.command_line.application import application


def commands_of(group, path=()):
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands_of(command, (*path, name))
        else:
            yield " ".join((*path, name)), command


COMMANDS = dict(commands_of(typer.main.get_command(application)))


@pytest.fixture(params=COMMANDS)
def name(request):
    return request.param


@pytest.fixture
def places(finished_job, finished_study, tmp_path):
    (tmp_path / "jobs.json").write_text(
        json.dumps([{"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}])
    )
    return {"JOB": finished_job, "STUDY": finished_study, "HERE": str(tmp_path)}


def test_it_says_what_it_does_with_an_example_and_explains_every_option(name):
    command = COMMANDS[name]
    assert command.help[0].isupper()
    assert f"`jointplay {name}" in command.help
    for parameter in command.params:
        if parameter.name != "help":
            assert parameter.help, parameter.name
            assert "{'" not in parameter.help  # fields of a document, which options have not


def test_it_can_print_json(name):
    if name == "openapi":
        return  # it prints nothing else
    options = [option for parameter in COMMANDS[name].params for option in parameter.opts]
    assert "--json" in options


PRINTED = {
    "run": (["pendulum", "--duration", "1", "-o", "HERE/OUT"], {"job", "peaks", "points"}),
    "submit": (["pendulum", "--duration", "1"], {"id", "state", "progress", "job", "cached"}),
    "submit --estimate": (["pendulum", "--duration", "1"], {"seconds", "steps", "bytes"}),
    "batch": (["HERE/jobs.json"], {"id", "size", "counts", "fraction", "is_finished"}),
    "ls": (["-n", "2"], {"jobs"}),
    "show": (["JOB"], {"job", "statistics", "peaks", "points"}),
    "show --wait": (["STUDY"], {"job", "statistics", "peaks", "points"}),
    "show --job": (["JOB"], {"kind", "scene", "duration"}),
    "export": (["JOB", "--channels", "slider7.x"], {"complete", "time", "channels"}),
    "export --points 9": (["JOB", "--channels", "slider7.x"], {"complete", "time", "channels"}),
    "export --table peaks": (["JOB"], {"peaks"}),
    "export --table impacts": (["JOB"], {"impacts"}),
    "export --table poincare": (["JOB"], {"complete", "time", "channels"}),
    "export --table points": (["STUDY"], {"complete", "values", "status", "columns"}),
    "plot": (["JOB", "orbit", "-o", "HERE"], {"figures"}),
    "compare": (["JOB", "JOB", "-o", "HERE/both.png", "--stop", "0.1"], {"figure", "peaks"}),
    "cite": (["JOB"], {"version", "bibtex", "SHA-256 of the job"}),
    "laws": (["hu-guo"], {"laws"}),
    "openapi": ([], {"openapi", "paths"}),
    "scene list": ([], {"scenes"}),
    "scene show": (["pendulum"], {"name", "bodies", "joints"}),
    "scene check": (["pendulum"], {"scene", "freedom", "residual", "problems"}),
    "scene schema": ([], {"$schema", "title", "properties", "$defs"}),
    "scene draw": (["pendulum", "-o", "HERE/pendulum.png"], {"figure", "problems"}),
}
"""By command: arguments, and keys of the document that scripts may rely on."""


@pytest.mark.parametrize("command", PRINTED)
def test_what_it_prints_is_one_json_document(jointplay, service_url, places, command):
    arguments, keys = PRINTED[command]
    for place, meant in places.items():
        arguments = [argument.replace(place, meant) for argument in arguments]
    words = command.split()
    takes_url = "url" in {one.name for one in COMMANDS[command.split(" -")[0]].params}
    asked = [] if command == "openapi" else ["--json"]
    asked += ["--url", service_url] if takes_url else []
    ended = jointplay(*words, *arguments, *asked)
    assert ended.code == 0, ended.err
    assert keys <= set(json.loads(ended.out))


def test_jobs_are_cancelled_retried_and_deleted_with_a_document(jointplay, service_url, worker):
    job_id = worker.submit(duration=0.77)
    at = ["--url", service_url, "--json"]
    assert json.loads(jointplay("cancel", job_id, *at).out)["state"] == "cancelled"
    (new,) = json.loads(jointplay("retry", job_id, *at).out)["retried"].values()
    assert json.loads(jointplay("delete", job_id, *at).out) == {"deleted": [job_id]}
    assert json.loads(jointplay("cancel", new, *at).out)["state"] == "cancelled"


def test_what_a_job_has_not_is_one_line(jointplay, service_url, finished_job, finished_study):
    for arguments in (["certificate", finished_job], ["export", finished_study, "--points", "9"]):
        ended = jointplay(*arguments, "--url", service_url)
        assert ended.code == 2
        assert ended.line()


BY_COMMAND = {
    "submit": "Client.submit simulate bifurcation chart continuation basins basin_stability sweep"
    " sensitivity poincare ensemble accuracy_study calibration estimate",
    "ls": "Client.jobs Batch.jobs",
    "show": "Client.job Job.refresh wait follow check statistics points accuracy attractors"
    " branch calibration study results",
    "export": "Job.history window poincare peaks impacts open export dataset",
    "plot": "Job.figure figures film",
    "certificate": "Job.certificate",
    "sensitivity": "Job.sensitivity",
    "cancel": "Job.cancel",
    "delete": "Job.delete Batch.delete",
    "retry": "Job.retry Batch.retry",
    "batch": "Client.submit_batch batch batches map Batch.wait refresh cancel",
    "laws": "Client.laws",
    "scene list": "Client.scenes",
    "scene check": "Client.check_scene poses",
    "scene show": "Client.scene",
}


@pytest.mark.parametrize("kind", [Client, Job, Batch])
def test_everything_that_the_client_can_do_is_a_command(kind):
    """A method that only describes or prints an object is no deed; what is dragged needs a hand."""
    described = {"to_document", "close", "renew", "advance", "states", "done_so_far"}
    described |= {"is_finished", "is_study", "scene_name", "seconds", "drag"}
    deeds = {
        name
        for name, member in inspect.getmembers(kind)
        if not name.startswith("_") and (callable(member) or inspect.isdatadescriptor(member))
    }
    deeds |= {"results"} if kind is Job else set()
    reached = set()
    for command, words in BY_COMMAND.items():
        assert command in COMMANDS
        owner = None
        for word in words.split():
            owner, _, name = word.rpartition(".") if "." in word else (owner, ".", word)
            if owner == kind.__name__:
                reached.add(name)
    assert deeds - described == reached
