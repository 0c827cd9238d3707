"""Seconds to a first moving frame and a first window, in a service that never ran a job before.

    python -m benchmarks first_frame [--only PRESET ...]

Every preset has a cache of its own, in which the integration loop is compiled and nothing else, as
`make install` leaves it, and a service of its own, up and idle.  Seconds are from the request:
until two samples of its motion can be read, and until it has ended; and those of a window,
asked for then.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import httpx

from jointplay.service.processes import running_service
from jointplay.solver.scene.presets import names

BETWEEN = 0.02  # s
DURATION = 2.0  # s
SHARE = 0.25
"""Length of the window, as a share of the run."""


def install(cache: Path) -> float:
    """Compile the loop into an empty cache; return the seconds."""
    begun = time.monotonic()
    command = [sys.executable, "-P", "-m", "jointplay.solver.kernels.compile_loop"]
    subprocess.run(command, check=True, env=os.environ | {"JOINTPLAY_CACHE": str(cache)})
    return time.monotonic() - begun


def first(url: str, preset: str) -> Mapping[str, float]:
    """Return the seconds until a frame moves and, from there, until a window is read."""
    job: dict[str, Any] = {"kind": "simulate", "scene": {"preset": preset}, "duration": DURATION}
    with httpx.Client(base_url=url, trust_env=False, timeout=300.0) as http:
        begun = time.monotonic()
        answer = http.post("/v1/jobs", json=job)
        if answer.status_code == 422:  # has parameters that must be given
            return {}
        address = answer.raise_for_status().headers["Location"]
        while True:
            history = http.get(f"{address}/history")
            if history.status_code == 200 and len(history.json()["time"]["values"]) > 1:
                break
            time.sleep(BETWEEN)
        moved = time.monotonic()
        while http.get(address).json()["state"] not in ("succeeded", "failed"):
            time.sleep(BETWEEN)
        ended = time.monotonic()
        window = {"start": 0.0, "stop": SHARE * DURATION}
        http.get(f"{address}/peaks", params=window).raise_for_status()
        return {
            "moves": moved - begun,
            "ended": ended - begun,
            "window": time.monotonic() - ended,
        }


def main() -> None:
    """Print a line for each preset."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", nargs="+", default=names(), choices=names())
    chosen = parser.parse_args().only
    with tempfile.TemporaryDirectory() as folder:
        installed = Path(folder) / "installed"
        print(f"the loop was compiled in {install(installed):.0f} s")
        for preset in chosen:
            cache = Path(folder) / preset
            shutil.copytree(installed, cache)
            os.environ["JOINTPLAY_CACHE"] = str(cache)
            with running_service(Path(folder) / f"{preset}-data", workers=2) as url:
                found = first(url, preset)
            words = "".join(f"{name:>9} {seconds:5.1f} s" for name, seconds in found.items())
            print(f"{preset:28s}{words or '  has parameters to be given'}", flush=True)


if __name__ == "__main__":
    main()
