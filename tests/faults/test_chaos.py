"""A service under a seeded schedule of faults keeps its word: `jointplay chaos`."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from jointplay.chaos.faults import FAULTS
from jointplay.chaos.processes import running
from jointplay.command_line.exits import Exit
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.waiting import until


def campaign(folder: Path, *options: str) -> dict[str, Any]:
    command = [sys.executable, "-P", "-m", "jointplay", "chaos", "--json", *options]
    done = subprocess.run(
        [*command, "--output", str(folder)], stdout=subprocess.PIPE, text=True, check=False
    )
    report: dict[str, Any] = json.loads(done.stdout)
    assert report["wrong"] == []
    assert done.returncode == 0
    return report


def test_a_service_keeps_its_word_under_faults(tmp_path: Path) -> None:
    options = ["--seed", "8", "--duration", "6", "--workers", "1"]
    for quick in ("garbage-handed-in", "worker-killed", "broker-killed", "damaged"):
        options += ["--fault", quick]
    report = campaign(tmp_path / "chaos", *options)
    assert report["struck"][0]["fault"] == "garbage-handed-in"
    assert all(one["recovery"] is not None for one in report["struck"])
    assert report["jobs"]["succeeded"] >= 3


def test_nothing_is_left_of_a_campaign_that_is_ended(tmp_path: Path) -> None:
    folder = tmp_path / "chaos"
    command = [sys.executable, "-P", "-m", "jointplay", "chaos", "--output", str(folder)]
    with subprocess.Popen([*command, "--workers", "1"], stderr=subprocess.PIPE) as process:
        until(lambda: {one.role for one in running(folder)} >= {"worker", "device"})
        process.terminate()
        _, told = process.communicate()
    assert running(folder) == []
    assert f"jointplay: interrupted; what it left is in {folder}\n" in told.decode()
    assert process.returncode == Exit.INTERRUPTED


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("fault", ["device-killed", "device-lost", "device-memory"])
def test_a_service_keeps_its_word_whatever_becomes_of_a_device(tmp_path: Path, fault: str) -> None:
    # alone: its worker takes half a minute to have work on a busy machine, and others come too late
    options = ["--seed", "4", "--duration", "20", "--workers", "2", "--fault", fault]
    report = campaign(tmp_path / "chaos", *options)
    assert {one["fault"] for one in report["struck"]} == {fault}
    assert all(one["recovery"] is not None for one in report["struck"])


@pytest.mark.long
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("seed", [1, 2])
def test_a_service_keeps_its_word_under_all_faults_at_length(tmp_path: Path, seed: int) -> None:
    report = campaign(tmp_path / "chaos", "--seed", str(seed), "--duration", "1500")
    struck = {one["fault"] for one in report["struck"]}
    assert struck | report["left_out"].keys() == FAULTS.keys()


@pytest.mark.long
@pytest.mark.timeout(3600)
def test_a_service_with_a_database_and_a_store_keeps_its_word_under_faults(tmp_path: Path) -> None:
    with running_server(fsync=True) as server, running_store() as endpoint:
        report = campaign(
            *(tmp_path / "chaos", "--seed", "3", "--duration", "600"),
            *("--catalogue", server.new("template0")),
            *("--results", f"s3://{BUCKET}/chaos?endpoint={endpoint}"),
        )
    struck = {one["fault"] for one in report["struck"]}
    assert struck | report["left_out"].keys() == FAULTS.keys()
    assert report["left_out"].keys() <= {"power-lost", "disk-full"}
