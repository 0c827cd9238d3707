"""Latency of a job of one revolution beside its solver: from POST to its peaks.

    python -m benchmarks latency

One warm worker, one job after the other.  The moments are those of the job's events, so that each
step can be measured: until a worker has it, until its results are sealed, until the client knows.
"""

import json
import os
import statistics
import tempfile
import time
from datetime import datetime
from pathlib import Path
from typing import Any

import httpx

from jointplay.service.processes import running_service

JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 2.0,
    "cache": False,
}
REPEATS = 15


def events(http: httpx.Client, address: str) -> dict[str, float]:
    """Return when each thing happened to a finished job, epoch seconds."""
    lines = http.get(f"{address}/events").text.splitlines()
    found: list[dict[str, Any]] = [
        json.loads(line.removeprefix("data: ")) for line in lines if '"seq"' in line
    ]
    return {one["type"]: datetime.fromisoformat(one["time"]).timestamp() for one in found}


def one_job(http: httpx.Client) -> dict[str, float]:
    """Return the seconds of each step of a job."""
    sent = time.time()
    answer = http.post("/v1/jobs", json=JOB, headers={"Prefer": "wait=60"}).raise_for_status()
    known = time.time()
    address = answer.headers["Location"]
    http.get(f"{address}/peaks").raise_for_status()
    read = time.time()
    solver = http.get(f"{address}/statistics").json()["solver_seconds"]
    happened = events(http, address)
    return {
        "POST until it is accepted": happened["queued"] - sent,
        "until a worker has it": happened["claimed"] - happened["queued"],
        "until it is computed, stored and sealed": happened["succeeded"] - happened["claimed"],
        "of these the solver": solver,
        "until the client knows": known - happened["succeeded"],
        "reading the peaks": read - known,
        "all but the solver": read - sent - solver,
    }


def main() -> None:
    """Print medians."""
    with (
        tempfile.TemporaryDirectory() as name,
        running_service(Path(name)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=300.0) as http,
    ):
        one_job(http)  # loads kernels, or compiles them
        one_job(http)
        print(f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        steps = [one_job(http) for _ in range(REPEATS)]
    for what in steps[0]:
        print(f"{what:<44}{1e3 * statistics.median(step[what] for step in steps):>8.1f} ms")


if __name__ == "__main__":
    main()
