"""The commands that talk to a service."""

import csv
import io
import json
import socket

import pytest

from jointplay.client.network import BlockingNetwork
from jointplay.records.job import JobError
from jointplay.service.app import create_app
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving


@pytest.fixture
def at(service_url):
    return ["--url", service_url]


def test_a_submitted_job_is_listed_shown_and_cancelled(jointplay, at):
    typed = ["--duration", "1", "--label", "typed", "--anew"]
    submitted = jointplay("submit", "pendulum", *typed, *at)
    assert submitted.code == 0
    job_id = submitted.out.strip()
    first = jointplay("ls", "-n", "1", *at).out
    assert job_id in first
    assert "queued" in first
    assert "typed" in first
    assert "queued" in jointplay("show", job_id, *at).out
    document = json.loads(jointplay("show", job_id, "--job", *at).out)
    assert (document["duration"], document["tolerance"]) == (1.0, 1e-6)
    for _ in range(2):
        assert jointplay("cancel", job_id, *at) == (0, f"{job_id}  cancelled\n", "")


def test_jobs_are_listed_by_what_they_are_and_deleted(jointplay, at, worker):
    job_id = worker.finished(label="to be found")
    chosen = ["--state", "succeeded", "--kind", "simulate", "--scene", "seven-bar-press"]
    chosen += ["--label", "to be found", "--since", "2020-01-01"]
    listed = jointplay("ls", *chosen, "--json", *at)
    (job,) = json.loads(listed.out)["jobs"]
    assert (job["id"], job["state"], job["progress"]["fraction"]) == (job_id, "succeeded", 1.0)
    assert jointplay("ls", *chosen, "--before", "2020-01-01", *at).out == ""
    wrong = jointplay("ls", "--state", "asleep", *at)
    assert wrong.code == 2
    assert "state" in wrong.line()
    assert jointplay("delete", job_id, *at) == (0, f"{job_id}  deleted\n", "")
    again = jointplay("delete", job_id, *at)
    assert again.code == 2
    assert "expired or was deleted" in again.line()


def test_what_a_job_waits_for_is_listed_and_shown(jointplay, at, worker, catalogue):
    waiting = worker.submit(label="stored later")
    worker.start(waiting)
    (block,) = catalogue.blocks(waiting)
    catalogue.put_off(block.id, block.attempt, "waiting for the results' place")
    row, *_ = jointplay("ls", "-n", "1", *at).out.splitlines()
    assert waiting in row
    assert row.endswith("stored later  (waiting for the results' place)")
    shown = jointplay("show", waiting, *at).out
    assert "state     running, t = 0 s (0%), waiting for the results' place\n" in shown
    again = worker.start(waiting).block
    catalogue.record_progress(again.id, again.attempt, 60.0, time=0.4, fraction=0.4)
    row, *_ = jointplay("ls", "-n", "1", *at).out.splitlines()
    assert row.endswith("  stored later")
    assert jointplay("cancel", waiting, *at).code == 0


def test_an_identical_job_is_computed_again_only_if_that_is_asked_for(jointplay, at):
    job = ["submit", "pendulum", "--duration", "0.8125", *at]
    first = jointplay(*job).out
    assert jointplay(*job).out == first
    assert jointplay(*job, "--anew").out != first


def test_a_job_is_listed_by_each_label_that_it_was_asked_for_with(jointplay, at):
    job = ["submit", "pendulum", "--duration", "0.8135", *at]
    (first,) = {jointplay(*job, "--label", label).out.strip() for label in ("a", "b")}
    for label in ("a", "b"):
        listed = jointplay("ls", "--label", label, *at).out
        assert listed.startswith(first)
        assert listed.endswith("a, b\n")


def test_a_label_cannot_command_the_terminal_of_whoever_lists_it(jointplay, at, http):
    label = "a\x1b[2J\x9b31m\u202eb\r\nc\u2028 \u00b5m é\u0301 😀"
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.03, "label": label}
    job_id = http.post("/v1/jobs", json=job).json()["id"]
    seen = r"a\x1b[2J\x9b31m\u202eb\r\nc\u2028" + " \u00b5m é\u0301 😀"
    (row,) = [one for one in jointplay("ls", *at).out.splitlines() if job_id in one]
    assert row.endswith(f"  {seen}")
    assert "\x1b" not in jointplay("show", job_id, *at).out
    (told,) = json.loads(jointplay("ls", "-n", "1", "--json", *at).out)["jobs"]
    assert told["label"] == label


def test_jobs_are_retried_and_deleted_by_what_they_are(jointplay, at, worker):
    named = ["--label", "to be retried", *at]
    jobs = [worker.submit(label="to be retried", duration=0.1 * n) for n in (1, 2, 3)]
    assert jointplay("retry", "--state", "failed", *named) == (0, "", "")
    error = JobError("platform", "worker-lost", "Lost.")
    worker.finish(worker.start(jobs[0]), BlockState.failed, error)
    jointplay("cancel", jobs[1], *at)
    retried = jointplay("retry", "--state", "failed", *named).out
    old, _, _, new = retried.split()
    assert old == jobs[0]
    assert jointplay("retry", old, *at).out == retried
    asked = jointplay("delete", "--state", "cancelled", *named)
    assert (asked.code, asked.out) == (2, "")
    assert "Delete 1 jobs and their results? Say --yes" in asked.line()
    deleted = jointplay("delete", "--state", "cancelled", "--yes", *named)
    assert deleted.out == f"{jobs[1]}  deleted\n"
    left = {one["id"] for one in json.loads(jointplay("ls", "--json", *named).out)["jobs"]}
    assert left == {jobs[0], jobs[2], new}
    for wrong in (["--state", "queued"], [], [old, "--label", "x"]):
        assert jointplay("delete", *wrong, "--yes", *at).code == 2


def test_a_batch_is_retried_and_deleted(jointplay, at, worker, tmp_path):
    press = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.3}
    file = tmp_path / "jobs.json"
    file.write_text(json.dumps([press, press | {"duration": 0.4}]))
    batch = jointplay("batch", file, *at).out.strip()
    refused = jointplay("delete", "--batch", batch, "--yes", *at)
    assert (refused.code, refused.line().count("2 jobs have not ended")) == (2, 1)
    assert "--label" in jointplay("batch", batch, "--label", "x", "--cancel", *at).line()
    jointplay("batch", batch, "--cancel", *at)
    new = jointplay("retry", "--batch", batch, *at).out
    assert new.endswith("  2 jobs: 2 queued\n")
    assert jointplay("retry", "--batch", batch, *at).out == new
    assert jointplay("delete", "--batch", batch, "--state", "failed", "--yes", *at).out == ""
    deleted = jointplay("delete", "--batch", batch, "--yes", *at)
    assert deleted.out == f"{batch}  deleted with 2 jobs\n"
    assert jointplay("batch", batch, *at).code == 2
    assert jointplay("delete", *new.split()[:1], "--yes", *at).code == 2


@pytest.mark.parametrize("option", ["--state", "--kind", "--label", "--scene"])
@pytest.mark.parametrize("command", [["delete", "--yes"], ["retry"]])
def test_an_empty_filter_does_not_mean_the_whole_batch(jointplay, at, tmp_path, command, option):
    press = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.3}
    file = tmp_path / "jobs.json"
    file.write_text(json.dumps([press | {"label": "kept"}]))
    batch = jointplay("batch", file, *at).out.strip()
    jointplay("batch", batch, "--cancel", *at)
    for named in (["--batch", batch, option, ""], [option, ""]):
        refused = jointplay(*command, *named, *at)
        assert (refused.code, refused.out) == (2, "")
        assert f"{option} is empty" in refused.line()
    assert jointplay("batch", batch, *at).out == "1 jobs: 1 cancelled\n"


def test_what_was_deleted_and_retried_before_a_refusal_is_told_as_json(jointplay, at, worker):
    one, other = (worker.submit(duration=length) for length in (0.771, 0.772))
    jointplay("cancel", one, *at)
    for command in ("retry", "delete"):
        ended = jointplay(command, one, other, "--json", *at)
        assert ended.code == 2
        assert other in ended.line()
        assert list(*json.loads(ended.out).values()) == [one]


def test_a_finished_job_is_shown_with_its_peaks(jointplay, at, finished_job):
    shown = jointplay("show", finished_job, *at).out
    assert "succeeded" in shown
    assert "slider7.ax" in shown
    assert "residual 1e-06 J" in shown


def test_a_job_that_failed_before_its_first_sample_is_shown(jointplay, at, worker):
    claim = worker.start(worker.submit())
    worker.store_nothing(claim)
    worker.finish(claim, BlockState.failed, JobError("solver", "step-size-underflow", "No step."))
    ended = jointplay("show", claim.job.id, *at)
    assert ended.code == 0
    row = next(line for line in ended.out.splitlines() if line.startswith("slider7.ax"))
    assert row.split() == ["slider7.ax", "nan", "nan", "nan", "nan", "m/s^2"]


def test_waiting_tells_by_the_exit_code_how_the_job_ended(jointplay, at, worker):
    assert jointplay("show", "--wait", worker.finished(), *at).code == 0
    claim = worker.start(worker.submit())
    worker.store(claim, complete=False)
    error = JobError("solver", "step-size-underflow", "Loosen the tolerance.", 0.5)
    worker.finish(claim, BlockState.failed, error)
    ended = jointplay("show", "--wait", claim.job.id, *at)
    assert ended.code == 3
    assert "Loosen the tolerance." in ended.err.splitlines()[-1]
    document = jointplay("show", "--wait", "--job", claim.job.id, *at)
    assert (document.code, json.loads(document.out)) == (3, claim.job.spec)
    assert "solver: Loosen the tolerance." in jointplay("show", claim.job.id, *at).out
    cancelled = worker.submit()
    jointplay("cancel", cancelled, *at)
    assert jointplay("show", "--wait", cancelled, *at).code == 4


def test_channels_of_a_job_are_exported_as_csv_and_json(jointplay, at, finished_job, tmp_path):
    selection = ["--channels", "slider7.x,A.normal_force", "--start", "0.5", "--stop", "0.51"]
    text = jointplay("export", finished_job, *selection, *at).out
    header, *rows = csv.reader(io.StringIO(text))
    assert header == ["time [s]", "slider7.x [m]", "A.normal_force [N]"]
    assert len(rows) == 11
    assert float(rows[0][0]) == 0.5
    file = tmp_path / "press.json"
    jointplay("export", finished_job, *selection, "--format", "json", "-o", file, *at)
    document = json.loads(file.read_text())
    assert document["time"]["values"] == [float(row[0]) for row in rows]
    assert document["channels"]["slider7.x"]["values"] == [float(row[1]) for row in rows]


def test_figures_of_a_job_are_fetched(jointplay, at, finished_job, tmp_path):
    drawn = jointplay("plot", finished_job, "orbit", "slider7.vx", "-o", tmp_path / "figures", *at)
    assert drawn.code == 0
    files = [tmp_path / "figures" / name for name in ("orbit.png", "slider7.vx.png")]
    assert drawn.out.split() == [str(file) for file in files]
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)
    page = ["--format", "eps", "--title", "Centres", "--units", "um", "--width", "120"]
    drawn = jointplay("plot", finished_job, "orbit", *page, "-o", tmp_path, *at)
    assert drawn.code == 0, drawn.err
    assert b"%%BoundingBox" in (tmp_path / "orbit.eps").read_bytes()
    wrong = jointplay("plot", finished_job, "orbit", "--units", "furlong", *at)
    assert wrong.code == 2
    assert "--units" in wrong.line()
    film = jointplay("plot", finished_job, "animation", "-o", tmp_path, *at)
    assert film.code == 2
    assert "A service draws no films; its page saves them" in film.line()


def test_what_a_service_refuses_is_one_line_with_the_field(jointplay, at, finished_job):
    wrong = jointplay("submit", "pendulum", "--duration", "-1", *at)
    assert wrong.code == 2
    assert "/duration" in wrong.line()
    for command in ("show", "cancel", "export"):
        unknown = jointplay(command, "0" * 26, *at)
        assert unknown.code == 2
        assert "0" * 26 in unknown.line()
    near = jointplay("export", finished_job, "--channels", "slider7.X", *at)
    assert near.code == 2
    assert "slider7.x" in near.line()


@pytest.mark.parametrize(
    "command", [["ls"], ["show", "0" * 26], ["submit", "pendulum"], ["cancel", "x"]]
)
def test_where_nobody_answers_the_exit_code_is_five(jointplay, command, monkeypatch):
    monkeypatch.setattr(BlockingNetwork, "sleep", lambda network, seconds: None)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    ended = jointplay(*command, "--url", f"http://127.0.0.1:{port}")
    assert ended.code == 5
    assert "jointplay serve" in ended.line()


def test_a_key_that_a_service_asks_for_is_told_as_it_is_given(jointplay, tmp_path):
    with serving(create_app(Settings(data=tmp_path, keys="required"))) as url:
        ends = [jointplay("ls", "--url", url), jointplay("worker", "--join", url, "--idle", "60")]
    for one in ends:
        assert "a key that is valid: give it in the variable JOINTPLAY_KEY" in one.line()
