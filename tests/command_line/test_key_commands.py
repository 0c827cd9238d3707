"""Keys made where the service's data is, and a service that does not start without one."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest


def test_a_key_is_made_listed_and_revoked(jointplay, tmp_path: Path) -> None:
    data = ["--data", str(tmp_path)]
    made = jointplay("key", "new", "--owner", "ada", "--days", "90", "--note", "laptop", *data)
    assert made.code == 0
    text = made.out.strip()
    assert text.startswith("jp_")
    name = text.split("_")[1]
    listed = jointplay("key", "ls", *data).out
    assert name in listed
    assert "jobs:read jobs:write results:read" in listed
    assert text not in listed
    document = json.loads(
        jointplay("key", "new", "--owner", "bob", "--scope", "admin", "--json", *data).out
    )
    assert document.keys() > {"key", "id", "owner", "scopes", "expires"}
    assert (document["owner"], document["scopes"], document["expires"]) == ("bob", ["admin"], None)
    assert jointplay("key", "revoke", name, *data).out.split() == [name, "revoked"]
    keys = json.loads(jointplay("key", "ls", "--json", *data).out)["keys"]
    assert [key["revoked"] is None for key in keys] == [False, True]
    assert "sha256" not in str(keys)


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["new", "--owner", "Ada L"], "is no owner"),
        (["new", "--owner", "ada", "--scope", "root"], "the scopes are jobs:write"),
        (["new", "--owner", "ada", "--note", "x" * 201], "at most 200"),
        (["new", "--owner", "ada", "--days", "0"], "leave it out for one that opens for ever"),
        (["revoke", "01234567"], "There is no key '01234567'"),
    ],
)
def test_what_cannot_be_is_one_line(
    jointplay, tmp_path: Path, arguments: list[str], line: str
) -> None:
    ended = jointplay("key", *arguments, "--data", str(tmp_path))
    assert ended.code == 2
    assert line in ended.line()


def test_a_service_that_others_can_reach_does_not_start_without_a_key(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "jointplay.service.processes.api", "--host", "0.0.0.0"]
    ended = subprocess.run(
        [*command, "--port", "0"],
        env=os.environ | {"JOINTPLAY_DATA": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert ended.returncode == 1
    assert "jointplay key new" in ended.stderr
    assert "Traceback" not in ended.stderr
