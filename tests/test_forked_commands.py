"""A command in a fork answers as one that is started."""

import subprocess
import sys

import pytest

from tests.forked_commands import forked_commands

STARTED = [sys.executable, "-m", "jointplay"]


@pytest.fixture(scope="module")
def forked(tmp_path_factory):
    with forked_commands(tmp_path_factory.mktemp("commands") / "bin") as folder:
        yield [str(folder / "jointplay")]


@pytest.mark.parametrize(
    ("arguments", "given"),
    [
        (["scene", "list"], ""),
        (["show", "NOTHING"], ""),  # refused, on the other stream
        (["scene", "check", "mine.json"], ""),  # beside which it runs
        (["scene", "check", "/dev/stdin"], "{}"),
    ],
)
def test_streams_folder_and_exit_code_are_those_of_the_command(arguments, given, forked, tmp_path):
    (tmp_path / "mine.json").write_text('{"name": "nothing else"}')
    answers = [
        subprocess.run(
            [*command, *arguments], input=given, cwd=tmp_path, capture_output=True, text=True
        )
        for command in (STARTED, forked)
    ]
    started, in_a_fork = [(one.returncode, one.stdout, one.stderr) for one in answers]
    assert in_a_fork == started


def test_variables_are_those_of_the_caller(forked):
    asked = subprocess.run(
        [*forked, "ls"],
        env={"JOINTPLAY_URL": "http://127.0.0.1:9"},
        capture_output=True,
        text=True,
    )
    assert "127.0.0.1:9" in asked.stderr
