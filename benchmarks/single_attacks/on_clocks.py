"""A worker of the service itself whose clock is wrong."""

import subprocess
import sys

from benchmarks.single_attacks.attacked import Attacked
from tests.machines.clock import Clock

_LONG = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 12.0}


def late(service: Attacked) -> str:
    """Compute a job by a worker whose clock is late: an hour, or what a store bears."""
    clock = Clock(service.folder)
    clock.set(-600.0 if "JOINTPLAY_RESULTS_URL" in service.variables else -3600.0)
    redis = f"unix://{service.folder / 'data' / 'broker' / 'redis.sock'}"
    job = service.submit(_LONG)
    own = service.environment | {"JOINTPLAY_REDIS_URL": redis} | clock.environment
    command = [sys.executable, "-P", "-m", "jointplay.worker"]
    worker = subprocess.Popen(
        command, env=own, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        ended = service.ended(job)
    finally:
        worker.terminate()
        worker.wait()
    lost, order = service.occurrences(job, "lost"), ended["started"] >= ended["created"]
    told = f"{ended['state']}, {lost} attempts lost"
    return f"{told}, started {'after' if order else 'before'} it was created"
