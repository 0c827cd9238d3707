"""A bar on a terminal, plain lines anywhere else, and Ctrl-C while waiting."""

import os
import signal
import subprocess
import sys

from jointplay.progress import progress
from tests.waiting import until


def test_without_a_terminal_only_the_end_of_something_quick_is_told(capsys):
    with progress("work") as report:
        for step in range(1000):
            report(step / 1000, f"step {step}")
        report(1.0, "all of it")
    assert capsys.readouterr().err == "work: 100% all of it\n"


def test_what_takes_long_without_a_word_is_told_meanwhile(capsys, monkeypatch):
    monkeypatch.setattr("jointplay.progress._QUIET", 0.01)
    with progress("work") as report:
        report(0.0, "preparing the kernel")
        found = []
        until(lambda: found.append(capsys.readouterr().err) or any(found))
        report(1.0, "all of it")
    assert "".join(found) == "work:   0% preparing the kernel\n"
    assert capsys.readouterr().err == "work: 100% all of it\n"


def test_a_terminal_shows_a_bar():
    ours, theirs = os.openpty()
    program = (
        "from jointplay.progress import progress\n"
        "with progress('work [/of] [0.3 mm]') as report:\n"  # a label, and no markup
        "    report(0.5, 'half'); report(1.0, 'all of it')\n"
    )
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    ended = subprocess.run([sys.executable, "-c", program], stderr=theirs, env=environment)
    os.close(theirs)
    shown = os.read(ours, 100_000).decode()
    os.close(ours)
    assert ended.returncode == 0
    assert "work [/of] [0.3 mm]" in shown
    assert "100%" in shown
    assert "━" in shown


def test_interrupted_waiting_says_how_to_come_back_and_leaves_the_job(http, worker, service_url):
    job_id = worker.submit()
    environment = {**os.environ, "JOINTPLAY_URL": service_url}
    program = (  # the wait has begun once the service was asked again
        "import os, signal, sys\n"
        "from jointplay.client import Job\n"
        "from jointplay.command_line.application import run\n"
        "look = Job.refresh\n"
        "def asked(self):\n"
        "    look(self)\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    return self\n"
        "Job.refresh = asked\n"
        "sys.exit(run(['show', '--wait', sys.argv[1]]))\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, job_id],
        env=environment,
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 128 + signal.SIGINT
    assert f"jointplay show --wait {job_id}" in ended.stderr.splitlines()[-1]
    assert http.get(f"/v1/jobs/{job_id}").json()["state"] == "queued"


def test_whoever_stops_reading_an_export_sees_no_traceback(tmp_path):
    program = "from jointplay.command_line import main; main()"
    reader, writer = os.pipe()
    os.close(reader)
    ended = subprocess.run(
        [sys.executable, "-c", program, "scene", "show", "seven-bar-press", "--json"],
        stdout=writer,
        stderr=subprocess.PIPE,
        text=True,
    )
    os.close(writer)
    assert ended.stderr == ""
