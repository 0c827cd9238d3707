"""Rate at which jobs are accepted, each durably: the most, and each one's wait at 50 a second.

    python -m benchmarks submission

The client is in this process, the service in others.  Every job has parameters of its own, so that
none is answered with another one's; then the same job is sent again and again.  At the fixed pace
requests are sent whatever the answers do, and wait from when they were due.  First the API alone
accepts, then beside a relay and a worker that computes what was accepted.
"""

import asyncio
import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import httpx

from jointplay.service.processes import running_service

SECONDS = 10.0
CLIENTS = 32
PACE = 50.0  # jobs a second


def different(number: int) -> bytes:
    """Return a job like no other."""
    return _document(clearance=1e-4 + 1e-9 * number, friction=0.01)


def same(_: int) -> bytes:
    """Return always the same job."""
    return _document(clearance=5e-4, friction=0.02)


def _document(**parameters: float) -> bytes:
    scene = {"preset": "seven-bar-press", "parameters": parameters}
    return json.dumps({"kind": "simulate", "scene": scene, "duration": 2.0}).encode()


class Line:
    """One connection that is kept."""

    def __init__(self, url: str, key: str = "") -> None:
        parts = urlsplit(url)
        self._key = f"Authorization: Bearer {key}\r\n" if key else ""
        self._host, self._port = str(parts.hostname), int(parts.port or 80)
        self._streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] | None = None

    async def post(self, body: bytes) -> int:
        """Send a job and return the status of the answer."""
        if self._streams is None:
            self._streams = await asyncio.open_connection(self._host, self._port)
        reader, writer = self._streams
        head = f"POST /v1/jobs HTTP/1.1\r\nHost: {self._host}\r\n{self._key}"
        head += "Content-Type: application/json\r\n"
        writer.write(f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body)
        answer = await reader.readuntil(b"\r\n\r\n")
        length = next(
            int(line[15:])
            for line in answer.lower().split(b"\r\n")
            if line[:15] == b"content-length:"
        )
        await reader.readexactly(length)
        return int(answer[9:12])

    def close(self) -> None:
        """Hang up."""
        if self._streams is not None:
            self._streams[1].close()


async def at_full_speed(
    url: str, job: Callable[[int], bytes], first: int, key: str = ""
) -> tuple[float, int]:
    """Return jobs a second over all clients, and how many were sent."""
    sent = first
    until = time.perf_counter() + SECONDS

    async def client() -> None:
        nonlocal sent
        line = Line(url, key)
        while time.perf_counter() < until:
            sent += 1
            assert await line.post(job(sent)) in {200, 202}
        line.close()

    begun = time.perf_counter()
    await asyncio.gather(*(client() for _ in range(CLIENTS)))
    return (sent - first) / (time.perf_counter() - begun), sent


async def at_a_pace(url: str, job: Callable[[int], bytes], first: int) -> list[float]:
    """Return the seconds each job waited for its answer, sorted."""
    free: list[Line] = []
    waited: list[float] = []
    begun = time.perf_counter()

    async def one(number: int, due: float) -> None:
        line = free.pop() if free else Line(url)
        assert await line.post(job(first + number)) in {200, 202}
        waited.append(time.perf_counter() - due)
        free.append(line)

    async with asyncio.TaskGroup() as tasks:
        for number in range(int(SECONDS * PACE)):
            due = begun + number / PACE
            await asyncio.sleep(max(due - time.perf_counter(), 0))
            tasks.create_task(one(number, due))
    for line in free:
        line.close()
    return sorted(waited)


def quantile(ordered: Sequence[float], share: float) -> float:
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)]


def measure(url: str) -> None:
    """Print the rates and waits of one service."""
    number = 1
    for what, job in (("different jobs", different), ("the same job", same)):
        rate, number = asyncio.run(at_full_speed(url, job, number))
        print(f"  {what + f', {CLIENTS} clients':<44}{rate:>8.0f} jobs/s")
    waited = asyncio.run(at_a_pace(url, different, number))
    for what, share in (("median", 0.5), ("99th percentile", 0.99)):
        wait = 1e3 * quantile(waited, share)
        print(f"  {f'different jobs at {PACE:g}/s, {what}':<44}{wait:>8.1f} ms")


@contextmanager
def api_alone(folder: Path) -> Iterator[str]:
    """Run only the process that answers, on a free port."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        command = [
            sys.executable,
            "-m",
            "jointplay.service.processes.api",
            "--fd",
            str(listening.fileno()),
        ]
        process = subprocess.Popen(
            command,
            env=os.environ | {"JOINTPLAY_DATA": str(folder)},
            pass_fds=[listening.fileno()],
            stderr=subprocess.DEVNULL,
        )
        url = f"http://127.0.0.1:{listening.getsockname()[1]}"
        try:
            httpx.get(f"{url}/healthz", timeout=60.0, trust_env=False).raise_for_status()
            yield url
        finally:
            process.terminate()
            process.wait()


def main() -> None:
    """Measure both."""
    for what, service in (("the API alone", api_alone), ("with a worker", running_service)):
        load = os.getloadavg()[0]
        print(f"{what}; load of the machine {load:.1f} on {os.cpu_count()} cores before")
        with tempfile.TemporaryDirectory() as name, service(Path(name)) as url:
            measure(url)


if __name__ == "__main__":
    main()
