"""`jointplay doctor`: what it prints, its exit codes, and that it disturbs no worker."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.client import Client
from jointplay.command_line.application import run
from tests.storage.reconciliation.installation import Installed, whole
from tests.storage.reconciliation.installation import in_a_folder as installed

__all__ = ["installed", "whole"]


def flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


def test_nothing_is_wrong_with_a_service_that_is_well(jointplay, installed: Installed) -> None:
    ended = jointplay("doctor", installed.settings.data)
    assert (ended.code, ended.out, ended.err) == (0, "nothing is wrong\n", "")


def test_settings_that_contradict_are_one_sentence(tmp_path: Path) -> None:
    """In a process of its own: the queue reads them when it is loaded."""
    command = [sys.executable, "-P", "-m", "jointplay", "doctor", str(tmp_path)]
    environment = os.environ | {"JOINTPLAY_LEASE": "4"}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    assert ended.stderr.startswith("jointplay: JOINTPLAY_LEASE is 4 s; it must be at least twice")


def test_what_is_wrong_is_told_in_a_table_mended_and_left(jointplay, installed: Installed) -> None:
    data = installed.settings.data
    flip(data / "results" / installed.sealed("succeeded").key)
    installed.sql("DELETE FROM outbox")
    looked = jointplay("doctor", data, "--dry-run")
    assert looked.code == 1
    assert looked.line() == "jointplay: findings: 2, can be mended: 2"
    heading, *rows = looked.out.splitlines()
    assert heading.split() == ["where", "what", "is", "wrong", "would", "be"]
    assert rows[0].startswith("catalogue  block ")
    assert rows[1].startswith("results    job ")
    assert rows[2] == (
        f"left to you: jointplay show {installed.jobs['succeeded']} --job > job.json;"
        " jointplay submit job.json"
    )
    mended = jointplay("doctor", data, "--json")
    assert mended.code == 1
    document = json.loads(mended.out)
    assert document["mended"] == 2
    assert [one["mended"] for one in document["findings"]] == ["announced", "marked as damaged"]
    again = jointplay("doctor", data)
    assert again.line() == "jointplay: findings: 1, mended: 0"
    installed.catalogue.delete(installed.jobs["succeeded"])
    assert jointplay("doctor", data).code == 0


def test_beside_workers_it_finds_nothing_and_changes_nothing(jointplay, service) -> None:
    """Jobs come, are computed and end while it looks, again and again."""
    url, data = service
    looks = 0
    with Client(url) as client:
        jobs = [client.simulate("pendulum", duration=1.0 + n) for n in range(6)]
        jobs += [client.sweep("pendulum", {"angle": [0.1, 0.3 + n]}, duration=1) for n in range(3)]
        while not all(job.refresh().is_finished for job in jobs) or looks < 2:
            ended = jointplay("doctor", data)
            assert (ended.code, ended.out) == (0, "nothing is wrong\n"), ended
            looks += 1
        assert {job.state for job in jobs} == {"succeeded"}
        assert {job.attempt for job in jobs} == {1}
    assert jointplay("doctor", data).code == 0


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("ran") / "OUT"
    assert run(["run", "pendulum", "--duration", "0.1", "-o", str(folder)]) == 0
    return folder


REACHED = {"time": 0.1, "fraction": 1.0}


def change(folder: Path, **fields: object) -> None:
    """Change what is said of the end of a run."""
    outcome = json.loads((folder / "outcome.json").read_text())
    (folder / "outcome.json").write_text(json.dumps(outcome | fields))


@pytest.fixture
def folder(ran: Path, tmp_path: Path) -> Path:
    return shutil.copytree(ran, tmp_path / "OUT")


def test_nothing_is_wrong_with_what_a_run_left(jointplay, folder: Path) -> None:
    assert jointplay("doctor", folder).code == 0


@pytest.mark.parametrize(
    ("harm", "found", "mended"),
    [
        (lambda out: flip(out / "results.zarr.zip"), "has other bytes", False),
        (lambda out: (out / "job.json").write_text("{}"), "is not the job of", True),
        (lambda out: (out / "job.json").unlink(), "is not the job of", True),
        (lambda out: (out / "outcome.json").write_text("{"), "is no JSON document", True),
        (lambda out: change(out, state="qucceeded"), "is not what a run writes", True),
        (lambda out: change(out, state="cancelled"), "is not the end of", True),
        (lambda out: change(out, state="failed"), "is not what a run writes", True),
        (lambda out: change(out, finished="yesterday"), "is not what a run writes", True),
        (lambda out: change(out, progress={"time": 0.1}), "is not what a run writes", True),
        (lambda out: change(out, progress=dict(REACHED, time=0.3)), "is not the end of", True),
        (lambda out: change(out, progress=dict(REACHED, fraction=0.5)), "is not the end of", True),
        (lambda out: flip(out / "peaks.csv"), "is not the table of results.zarr.zip", True),
        (lambda out: (out / "running").mkdir(), "is left over", True),
        (lambda out: (out / "results.zarr.zip.0123.partial").touch(), "is left over", True),
    ],
)
def test_what_is_wrong_with_a_run_is_found(jointplay, folder: Path, harm, found, mended) -> None:
    before = (folder / "job.json").read_bytes()
    harm(folder)
    ended = jointplay("doctor", folder)
    assert ended.code == 1
    assert found in ended.out
    assert (jointplay("doctor", folder).code == 0) == mended
    assert (f"jointplay run {folder}/job.json -o AGAIN" in ended.out) != mended
    assert (folder / "job.json").read_bytes() == before


def test_the_table_of_a_study_is_that_of_its_results(jointplay, tmp_path: Path) -> None:
    study = ("--sweep", "angle=0.1,0.2", "--duration", "0.1", "-o", tmp_path / "OUT")
    assert jointplay("run", "pendulum", *study).code == 0
    table = tmp_path / "OUT" / "points.csv"
    written = table.read_text()
    assert jointplay("doctor", tmp_path / "OUT").code == 0
    table.write_text(written.replace("0.1", "0.3"))
    looked = jointplay("doctor", tmp_path / "OUT", "--dry-run")
    assert (looked.code, "is not the table of" in looked.out) == (1, True)
    assert jointplay("doctor", tmp_path / "OUT").code == 1
    assert table.read_text() == written
    table.unlink()  # no table is as good as one: Python's runs leave none
    assert jointplay("doctor", tmp_path / "OUT").code == 0


def test_a_run_that_was_cut_short_can_be_repeated(jointplay, folder: Path) -> None:
    (folder / "results.zarr.zip").unlink()
    (folder / "outcome.json").unlink()
    assert "was cut short, or goes on" in jointplay("doctor", folder).out


def test_a_folder_of_neither_is_refused(jointplay, tmp_path: Path) -> None:
    ended = jointplay("doctor", tmp_path)
    assert ended.code == 2
    assert "neither a service's data nor the results of a run" in ended.line()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(shutil.which("nvidia-smi") is not None, reason="there may be a device")
def test_without_a_device_there_is_a_sentence(jointplay) -> None:
    ended = jointplay("doctor", "--device")
    assert ended.code == 1
    assert ended.line().startswith("jointplay: there is no driver of a device: ")
