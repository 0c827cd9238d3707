"""Tiled and this service hand out the same Zarr store: what a client of each waits for.

    python -m venv ELSEWHERE && ELSEWHERE/bin/pip install 'tiled[all]'
    python -m benchmarks.beside_tiled ELSEWHERE/bin/python

Tiled has an environment of its own and is reached through its Python client; this service through
stock zarr and its own `/history`.  Both take turns, on one machine; medians are printed.
"""

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import httpx
import numpy as np
import zarr

from benchmarks.results_http import FEW, service, stored
from jointplay.storage.settings import Settings

SAMPLES = 10_000_001
POINTS = 2000
ROUNDS = 7
PORT = 8763
ADDRESS = f"http://127.0.0.1:{PORT}"

TILED_CLIENT = f"""
import sys, time
import numpy as np
from tiled.client import from_uri

catalogue = from_uri("{ADDRESS}")
array = catalogue["run"]["{FEW[0]}"]

def overview():
    whole = array[: {SAMPLES} // {POINTS} * {POINTS}].reshape({POINTS}, -1)
    return whole.min(1), whole.max(1)

actions = {{
    "open": lambda: catalogue["run"]["{FEW[0]}"],
    "slice": lambda: array[5_000_000:5_001_000],
    "full": lambda: array[:],
    "overview": overview,
    "strided": lambda: array[:: {SAMPLES} // {POINTS}],
}}
print("ready", flush=True)
for line in sys.stdin:
    begun = time.perf_counter()
    actions[line.strip()]()
    print(time.perf_counter() - begun, flush=True)
"""


class Tiled:
    """A Tiled server of one folder, and a client of it, both in Tiled's environment."""

    def __init__(self, python: str, folder: Path, logs: Path) -> None:
        home = os.environ | {"HOME": str(logs), "PYTHONPATH": ""}
        serve = [python, "-m", "tiled", "serve", "directory", str(folder), "--public"]
        with (logs / "tiled.log").open("wb") as log:
            self._server = subprocess.Popen(
                [*serve, "--port", str(PORT)], stdout=log, stderr=log, env=home
            )
        self._wait_until_registered()
        self._client = subprocess.Popen(
            [python, "-c", TILED_CLIENT],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=home,
        )
        assert self._client.stdout is not None
        assert self._client.stdout.readline() == "ready\n"

    def _wait_until_registered(self) -> None:
        for _ in range(600):
            try:
                address = f"{ADDRESS}/api/v1/metadata/run/{FEW[0]}"
                if httpx.get(address, trust_env=False).status_code == 200:
                    return
            except httpx.HTTPError:
                pass
            time.sleep(0.1)
        raise SystemExit("Tiled does not serve the store; is its environment complete?")

    def seconds(self, action: str) -> float:
        """Have the client do something and return how long it took."""
        assert self._client.stdin is not None
        assert self._client.stdout is not None
        self._client.stdin.write(f"{action}\n")
        self._client.stdin.flush()
        return float(self._client.stdout.readline())

    def stop(self) -> None:
        """End both."""
        for process in (self._client, self._server):
            process.terminate()
            process.wait()


def ours(http: httpx.Client, job: str) -> dict[str, Callable[[], Any]]:
    """Return the same actions at this service."""
    address = f"{http.base_url}/v1/jobs/{job}/zarr".replace("//v1", "/v1")
    array = zarr.open_group(address, mode="r")[FEW[0]]
    assert isinstance(array, zarr.Array)

    def overview() -> object:
        query = {"channels": FEW[0], "points": str(POINTS)}
        return http.get(f"/v1/jobs/{job}/history", params=query).raise_for_status().json()

    return {
        "open": lambda: zarr.open_group(address, mode="r")[FEW[0]],
        "slice": lambda: array[5_000_000:5_001_000],
        "full": lambda: array[:],
        "overview": overview,
    }


def seconds(action: Callable[[], Any]) -> float:
    begun = time.perf_counter()
    action()
    return time.perf_counter() - begun


def main() -> None:
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    root = Path(tempfile.mkdtemp(prefix="beside_tiled_"))
    settings = Settings(data=root / "data")
    settings.data.mkdir()
    try:
        with (
            service(settings.data) as url,
            httpx.Client(base_url=url, trust_env=False, timeout=60.0) as http,
        ):
            job = stored(http, settings, FEW, SAMPLES)
            (root / "tiled").mkdir()
            with ZipFile(settings.data / "results" / settings.sealed_run(job, 1).key) as packed:
                packed.extractall(root / "tiled" / "run.zarr")  # Tiled takes folders
            tiled = Tiled(sys.argv[1], root / "tiled", root)
            try:
                compare(ours(http, job), tiled)
            finally:
                tiled.stop()
    finally:
        shutil.rmtree(root)


def compare(here: dict[str, Callable[[], Any]], tiled: Tiled) -> None:
    print(f"load over the last minute: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print(f"{f'{SAMPLES} samples, medians of {ROUNDS}':<46}{'here':>10}{'Tiled':>12}{'ratio':>8}")
    for what, action, theirs in (
        ("open one channel", "open", "open"),
        ("slice of 1000 samples", "slice", "slice"),
        ("all samples, 80 MB", "full", "full"),
        (f"extremes of {POINTS} bins", "overview", "overview"),
        (f"extremes, and every {SAMPLES // POINTS}th sample there", "overview", "strided"),
    ):
        pairs = [(seconds(here[action]), tiled.seconds(theirs)) for _ in range(ROUNDS)]
        mine, its = (float(np.median(column)) for column in zip(*pairs, strict=True))
        ratio = statistics.median(b / a for a, b in pairs)
        print(f"{what:<46}{1e3 * mine:>7.1f} ms{1e3 * its:>9.1f} ms{ratio:>8.1f}")


if __name__ == "__main__":
    main()
