"""A worker whose clock is wrong holds its blocks: leases go by one clock."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from jobs import IMPATIENT, catalogue_of, ended, in_mid_block, submit

from jointplay.service.processes import running_service
from jointplay.solver.kinds import admit
from jointplay.storage.catalogue.records import JobState
from tests.backends import BACKENDS, backends, settings_at
from tests.machines.clock import COMPILER, Clock

OFF = {"folder": 3600.0, "bucket": 600.0}
"""Seconds; a store refuses what was signed by a clock that is a quarter of an hour off."""
LONG = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 12.0}


@pytest.mark.skipif(COMPILER is None, reason="clocks of programs are set by a library in C")
@pytest.mark.parametrize("kind", BACKENDS)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_worker_whose_clock_is_wrong_loses_nothing(
    tmp_path: Path, kind: str, sign: float
) -> None:
    data = tmp_path / "data"
    clock = Clock(tmp_path)
    clock.set(sign * OFF[kind])
    with (
        backends(kind) as variables,
        catalogue_of(settings_at(data, variables)) as catalogue,
        running_service(data, 0, IMPATIENT | variables),
    ):
        redis = f"unix://{data / 'broker' / 'redis.sock'}"
        own = variables | {"JOINTPLAY_DATA": str(data), "JOINTPLAY_REDIS_URL": redis}
        worker = subprocess.Popen(
            [sys.executable, "-P", "-m", "jointplay.worker"],
            env=os.environ | IMPATIENT | own | clock.environment,
        )
        try:
            job = submit(catalogue, admit(LONG))
            held = in_mid_block(catalogue, job)
            assert held.lease_until is not None
            assert abs(held.lease_until - catalogue.clock()) < OFF[kind] / 2
            over = ended(catalogue, job)
        finally:
            worker.terminate()
            worker.wait()
        assert over.state is JobState.succeeded
        assert over.attempt == 1
        assert over.created <= (over.started or 0.0) <= (over.finished or 0.0)
