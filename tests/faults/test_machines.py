"""A service on several machines keeps its word under faults: `python -m tests.machines`."""

import json
import os
import signal
import subprocess
import sys
from itertools import islice
from pathlib import Path

import pytest

from jointplay.chaos.schedule import schedule
from tests.machines.clock import COMPILER
from tests.machines.faults import FAULTS

ALONE = ["unshare", "--net", "--pid", "--fork", "--kill-child", "--mount-proc"]


@pytest.fixture(scope="module", autouse=True)
def _machines() -> None:
    """Skip by name where network namespaces cannot be made, or clocks not be set."""
    if COMPILER is None:
        pytest.skip("clocks of programs are set by a library in C, and there is no cc")
    made = os.getuid() == 0 and subprocess.run([*ALONE, "true"], check=False).returncode == 0
    if not made:
        pytest.skip("only root can make network namespaces")


def test_every_fault_comes_before_any_comes_again() -> None:
    strikes = [strike.fault for strike in islice(schedule(3, 360.0, FAULTS), len(FAULTS))]
    assert {*strikes} == FAULTS.keys()


def test_faults_of_the_network_and_of_the_store_do_what_they_say() -> None:
    command = [*ALONE, sys.executable, "-m", "tests.machines.trial"]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    assert (done.stderr, done.returncode) == ("", 0)


def test_sigterm_ends_it_with_all_that_it_started(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "tests.machines", "--jobs", "1"]
    variables = os.environ | {"TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stderr=subprocess.PIPE, env=variables) as campaign:
        assert campaign.stderr is not None
        assert campaign.stderr.readline() == b"computing 1 jobs undisturbed\n"
        campaign.send_signal(signal.SIGTERM)
        campaign.stderr.read()  # until all have ended that may write there
    assert campaign.returncode == 128 + signal.SIGTERM


@pytest.mark.long
@pytest.mark.timeout(7200)
@pytest.mark.parametrize(("seed", "jobs"), [(1, 40), (7, 200)])
def test_a_service_on_several_machines_keeps_its_word(seed: int, jobs: int) -> None:
    command = [sys.executable, "-m", "tests.machines", "--json"]
    done = subprocess.run(
        [*command, "--seed", str(seed), "--jobs", str(jobs)],
        stdout=subprocess.PIPE,
        check=False,
    )
    report = json.loads(done.stdout)
    assert report["wrong"] == []
    assert done.returncode == 0
    assert {one["fault"] for one in report["struck"]} == FAULTS.keys()
    assert all(one["back"] is not None for one in report["struck"])
    assert report["jobs"].keys() <= {"succeeded", "cancelled"}
