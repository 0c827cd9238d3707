"""Memory of each process of a service: at its start, and after what may make it grow.

    python -m benchmarks memory [--jobs 20000] [--computed 300]

Bodies that are wrong in many ways, scenes made to be slow, windows of results, streams of events,
and then jobs by the thousand.  The last lines tell how much each process grew per thousand jobs,
after the first thousand.  Resident memory without what is shared with files.
"""

import argparse
import socket
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx

from benchmarks.hostile import send
from benchmarks.hostile_bodies import hostile_bodies
from jointplay.chaos.inside import FOLDER_VARIABLE
from jointplay.chaos.processes import ROLES, running
from jointplay.service.processes import running_service

WINDOWS = 5000
STREAMS = 200
COLUMNS = (*ROLES, "checking")
QUIET = 2.0  # s, for what is given back a moment later
IDLE = 32.0  # s, in which the API lets go of readers that nobody uses
PATIENCE = 600.0  # s


class Table:
    """Rows of memory, MB, a column for each role of a process."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        print(f"{'MB after':<34}" + "".join(f"{role:>12}" for role in COLUMNS))

    def row(self, after: str) -> dict[str, float]:
        """Measure and print a row."""
        time.sleep(QUIET)
        found = dict.fromkeys(COLUMNS, 0.0)
        for process in running(self._folder):
            if process.role in found:
                found[process.role] += anonymous(process.pid)
        print(f"{after:<34}" + "".join(f"{found[role]:12.1f}" for role in COLUMNS), flush=True)
        return found


def anonymous(pid: int) -> float:
    """Return a process's resident memory that no file backs, MB; 0 if it has ended."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0.0
    line = next((one for one in status.splitlines() if one.startswith("RssAnon:")), "RssAnon: 0 kB")
    return int(line.split()[1]) / 1024


def job(number: int, duration: float = 2.0) -> dict[str, Any]:
    """Return a job like no other."""
    parameters = {"clearance": 1e-4 + 1e-9 * number, "friction": 0.01}
    scene = {"preset": "seven-bar-press", "parameters": parameters}
    return {"kind": "simulate", "scene": scene, "duration": duration}


def send_hostile_bodies(http: httpx.Client) -> None:
    """Send bodies that are wrong or slow to look at; what is accepted is cancelled."""
    for one in hostile_bodies():
        answer = send(http, one)
        assert answer.status_code < 500, answer.text[:200]
        if answer.is_success:
            http.post(f"{answer.headers['Location']}/cancel").raise_for_status()


def look_through_windows(http: httpx.Client) -> None:
    """Read many windows of one run, and draw a few figures of it."""
    answer = http.post("/v1/jobs", json=job(0, 40.0), headers={"Prefer": "wait=60"}, timeout=90.0)
    address = answer.headers["Location"]
    finish(http, address)
    for number in range(WINDOWS):
        start = 0.005 * number
        http.get(
            f"{address}/history", params={"start": start, "stop": start + 1.0}
        ).raise_for_status()


def finish(http: httpx.Client, address: str) -> None:
    """Wait for a job."""
    until = time.monotonic() + PATIENCE
    while http.get(address, params={"wait": 30}, timeout=60.0).json()["finished"] is None:
        assert time.monotonic() < until, address


def open_streams(http: httpx.Client) -> None:
    """Open streams of a job's events, all at once, and hang up."""
    address = http.post("/v1/jobs", json=job(1, 1e5)).raise_for_status().headers["Location"]
    parts = urlsplit(str(http.base_url))
    head = f"GET {address}/events HTTP/1.1\r\nHost: {parts.hostname}\r\n\r\n".encode()
    streams = []
    for _ in range(STREAMS):
        stream = socket.create_connection((parts.hostname, parts.port or 80))
        stream.sendall(head)
        stream.recv(4096)
        streams.append(stream)
    time.sleep(QUIET)
    for stream in streams:
        stream.close()
    http.post(f"{address}/cancel").raise_for_status()
    finish(http, address)


def submit(http: httpx.Client, numbers: range) -> None:
    """Submit jobs that all differ, and cancel them, so that none is computed."""
    for number in numbers:
        address = http.post("/v1/jobs", json=job(number)).raise_for_status().headers["Location"]
        http.post(f"{address}/cancel").raise_for_status()


def compute(http: httpx.Client, numbers: range) -> None:
    """Have jobs computed and read their peaks."""
    sent = [
        http.post("/v1/jobs", json=job(number)).raise_for_status().headers["Location"]
        for number in numbers
    ]
    for address in sent:
        finish(http, address)
        http.get(f"{address}/peaks").raise_for_status()


def soak(
    table: Table, http: httpx.Client, what: Callable[[httpx.Client, range], None], numbers: range
) -> None:
    """Do something with many jobs, in five parts; print the growth per thousand after the first."""
    name, part = what.__name__, len(numbers) // 5
    rows = []
    for first in parts(numbers, part):
        what(http, range(first, first + part))
        rows.append(table.row(f"{name}, {first + part - numbers.start} jobs"))
    thousands = (len(rows) - 1) * part / 1000
    grown = "".join(f"{(rows[-1][role] - rows[0][role]) / thousands:12.2f}" for role in COLUMNS)
    print(f"{'  MB per 1000 jobs':<34}{grown}")


def parts(numbers: range, length: int) -> Iterator[int]:
    """Yield the first number of each whole part."""
    yield from range(numbers.start, numbers.stop - length + 1, length)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks memory")
    parser.add_argument("--jobs", type=int, default=20_000, help="jobs that are only submitted")
    parser.add_argument("--computed", type=int, default=300, help="jobs that are computed")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        mark = {FOLDER_VARIABLE: str(folder)}
        with (
            running_service(folder / "data", environment=mark) as url,
            httpx.Client(base_url=url, trust_env=False, timeout=600.0) as http,
        ):
            table = Table(folder)
            table.row("start")
            compute(http, range(1_000_000, 1_000_003))
            table.row("3 jobs computed and read")
            for step in (send_hostile_bodies, look_through_windows, open_streams):
                step(http)
                table.row(step.__name__.replace("_", " "))
            soak(table, http, submit, range(10, 10 + arguments.jobs))
            soak(table, http, compute, range(2_000_000, 2_000_000 + arguments.computed))
            time.sleep(IDLE)
            table.row("half a minute of rest")


if __name__ == "__main__":
    main()
