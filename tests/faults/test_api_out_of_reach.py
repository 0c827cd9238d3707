"""A joined worker that lives while its service is out of reach loses no job by that."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from jobs import IMPATIENT, api_of, catalogue_of, ended, in_mid_block, standing, submit

from jointplay.service.processes import running_service
from jointplay.solver.kinds import admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, JobState
from tests.backends import BACKENDS, backends, settings_at
from tests.waiting import until

LONG = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {"clearance": 5e-4, "friction": 0.1}},
    "duration": 100.0,
    "channels": ["slider7.x"],
    "certificate": False,
}
HOLDS = 4
"""More than losses after which a block is given up."""


@pytest.mark.parametrize("kind", BACKENDS)
def test_a_service_that_is_away_for_longer_than_leases_ends_no_job(
    tmp_path: Path, kind: str
) -> None:
    data = tmp_path / "data"
    environment = IMPATIENT | {"JOINTPLAY_MAX_ATTEMPTS": "3"}
    with (
        backends(kind) as variables,
        catalogue_of(settings_at(data, variables)) as catalogue,
        running_service(data, 0, environment | variables) as url,
    ):
        (api,) = api_of(data)
        worker = subprocess.Popen(
            [sys.executable, "-P", "-m", "jointplay", "worker", "--join", url],
            env={name: one for name, one in os.environ.items() if name[:10] != "JOINTPLAY_"},
            cwd=tmp_path,
        )
        try:
            job = submit(catalogue, admit(LONG))
            in_mid_block(catalogue, job, after=0.1)
            for _ in range(HOLDS):
                until_held(catalogue, job)
                os.kill(api, signal.SIGSTOP)
                try:
                    until(lambda: lost(catalogue, job))
                finally:
                    os.kill(api, signal.SIGCONT)
            assert ended(catalogue, job).state is JobState.succeeded
        finally:
            worker.terminate()
            worker.wait()


def until_held(catalogue: Catalogue, job: str) -> None:
    def is_held() -> bool:
        assert not catalogue.get(job).state.terminal
        return catalogue.blocks(job)[0].state is BlockState.running

    until(is_held, progress=lambda: standing(catalogue, job))


def lost(catalogue: Catalogue, job: str) -> bool:
    return catalogue.blocks(job)[0].state is not BlockState.running
