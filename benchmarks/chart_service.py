"""A chart of a million points and a service: seconds to its first picture, memory, looks.

    python -m benchmarks chart_service [SIDE]

Two workers compute it for as long as `SECONDS` after the first picture; then it is cancelled.
"""

import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import Any

import httpx

from jointplay.service.processes import running_service

SIDE = 1000
SECONDS = 30.0
BETWEEN = 0.5  # s, as the page looks
JOB: dict[str, Any] = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "settle": 60,
    "record": 16,
    "tolerance": 1e-6,
    "indicators": ["recurrence"],
}


def children(process: int) -> Iterator[int]:
    """Yield a process and all that it started."""
    yield process
    tasks = Path(f"/proc/{process}/task")
    for task in tasks.iterdir() if tasks.exists() else ():
        for child in (task / "children").read_text().split():
            yield from children(int(child))


def memories() -> dict[str, float]:
    """Return the largest memory, MB, of processes of each kind below this one."""
    found: dict[str, float] = {}
    for process in children(os.getpid()):
        try:
            lines = Path(f"/proc/{process}/status").read_text().splitlines()
            words = Path(f"/proc/{process}/cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        most = [float(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM")]
        kind = next((word for word in words if word.startswith("jointplay.")), words[0])
        found[kind] = max([found.get(kind, 0.0), *most])
    return found


def axes(side: int) -> dict[str, Any]:
    """Return the axes of a chart of so many points a side."""
    return {
        name: {"parameter": parameter, "values": {"from": low, "to": high, "count": side}}
        for name, parameter, low, high in (
            ("along", "speed", 10.0, 40.0),
            ("by", "amplitude", 1e-3, 2e-2),
        )
    }


def ended(client: httpx.Client, job: str) -> int:
    """Return how many points of a chart have ended."""
    chart = client.get(f"/v1/jobs/{job}/chart")
    return int(chart.json()["ended"]) if chart.status_code == 200 else 0


def main() -> None:
    """Print it."""
    side = int(sys.argv[1]) if len(sys.argv) > 1 else SIDE
    with (
        tempfile.TemporaryDirectory() as folder,
        running_service(Path(folder) / "data", workers=2) as url,
        httpx.Client(base_url=str(url), timeout=600.0) as client,
    ):
        begun = time.monotonic()
        answer = client.post("/v1/jobs", json=JOB | axes(side)).raise_for_status()
        job, queued = answer.json()["id"], time.monotonic() - begun
        count, looks = 0, []
        shown = 0.0
        while not shown or time.monotonic() - begun < shown + SECONDS:
            looked = time.monotonic()
            count = ended(client, job)
            if count:
                client.get(
                    f"/v1/jobs/{job}/tiles/motion/0/0/0.png", params={"ended": count}
                ).raise_for_status()
                shown = shown or time.monotonic() - begun
                looks.append(time.monotonic() - looked)
            time.sleep(BETWEEN)
        client.post(f"/v1/jobs/{job}/cancel").raise_for_status()
        print(f"{side} x {side} points: accepted after {queued:.1f} s, first picture {shown:.1f} s")
        print(
            f"{count} points {SECONDS:g} s later; a look (axes, quantities and a tile)"
            f" {median(looks):.2f} s, at most {max(looks):.2f} s"
        )
        for kind, most in sorted(memories().items()):
            print(f"{kind:40s} {most:6.0f} MB")


if __name__ == "__main__":
    main()
