"""A worker whose clock is an hour late holds its blocks: leases go by one clock."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from jobs import IMPATIENT, catalogue_of, ended, in_mid_block, submit

from jointplay.service.processes import running_service
from jointplay.solver.kinds import admit
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.settings import Settings
from tests.machines.clock import COMPILER, Clock

HOUR = 3600.0
LONG = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 12.0}


@pytest.mark.skipif(COMPILER is None, reason="clocks of programs are set by a library in C")
@pytest.mark.parametrize("ahead", [-HOUR, HOUR])
def test_a_worker_whose_clock_is_wrong_loses_nothing(tmp_path: Path, ahead: float) -> None:
    settings = Settings(data=tmp_path / "data")
    clock = Clock(tmp_path)
    clock.set(ahead)
    with (
        catalogue_of(settings) as catalogue,
        running_service(settings.data, workers=0, environment=IMPATIENT),
    ):
        redis = f"unix://{settings.data / 'broker' / 'redis.sock'}"
        own = {"JOINTPLAY_DATA": str(settings.data), "JOINTPLAY_REDIS_URL": redis}
        worker = subprocess.Popen(
            [sys.executable, "-P", "-m", "jointplay.worker"],
            env=os.environ | IMPATIENT | own | clock.environment,
        )
        try:
            job = submit(catalogue, admit(LONG))
            held = in_mid_block(catalogue, job)
            assert held.lease_until is not None
            assert abs(held.lease_until - catalogue.clock()) < HOUR / 2
            over = ended(catalogue, job)
        finally:
            worker.terminate()
            worker.wait()
        assert over.state is JobState.succeeded
        assert over.attempt == 1
        assert over.created <= (over.started or 0.0) <= (over.finished or 0.0)
